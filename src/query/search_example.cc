#include "query/search_example.h"

#include <algorithm>
#include <tuple>

namespace reprise {

double seconds_of(const Example& example) {
  return std::max(example.stretch.seconds(), 1 / PostureConstants::rate);
}

Stretch whole_of(const PostureTrack& track) {
  return {0, static_cast<double>(track.frames() - 1) / PostureConstants::rate};
}

bool better(const Match& a, const Match& b) {
  return std::tuple(a.unlikeness, a.take, a.stretch.begin) <
         std::tuple(b.unlikeness, b.take, b.stretch.begin);
}

bool comes_before(const Match& a, const Match& b) {
  if (a.repeat != b.repeat) return a.repeat;
  if (a.repeat && a.distance_mm != b.distance_mm) return a.distance_mm < b.distance_mm;
  return better(a, b);
}

std::vector<const PostureTrack*> tracks_of(const std::vector<LibraryTake>& library,
                                           const PlanGroup& group) {
  std::vector<const PostureTrack*> tracks;
  for (const std::size_t take : group.takes) tracks.push_back(&library[take].track);
  return tracks;
}

}  // namespace reprise
