#include "query/whole_search.h"

namespace reprise {

std::vector<Match> whole_matches(const std::vector<LibraryTake>& library, PlanGroup& group,
                                 const Example& example, const std::vector<bool>& accept,
                                 std::size_t count) {
  if (!group.ranking) group.ranking.emplace(tracks_of(library, group));
  const double seconds = seconds_of(example);
  const int samples = samples_for(seconds);
  const MotionForm form = motion_form(*example.track, example.stretch, samples);
  std::vector<Match> matches;
  for (const std::size_t i : group.ranking->nearest(*example.track, count, accept)) {
    const std::size_t take = group.takes[i];
    const Stretch stretch = whole_of(library[take].track);
    const MotionForm other = motion_form(library[take].track, stretch, samples);
    matches.push_back({take, stretch, unlikeness(form, other, take_weights), std::nullopt, false});
  }
  return matches;
}

}  // namespace reprise
