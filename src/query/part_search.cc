#include "query/part_search.h"

#include <algorithm>
#include <cmath>

#include "query/time_warp.h"

namespace reprise {
namespace {

/// mm that a factor e between a take's length and that of a whole example counts against its parts.
constexpr double part_weight = 100.0;
/// Motion that recurs does so next to itself more often than elsewhere: about this many of the best
/// places of a part, so many steps of half a length to both sides are looked at as well.
constexpr std::size_t places_looked_about = 12;
constexpr int steps_looked_about = 2;
/// Rows of the example when its place in a take is looked for.
constexpr int most_fitted_rows = 64;

/// An example of which parts are compared.
struct PartExample {
  const std::vector<LibraryTake>& library;
  const Example& example;
  double seconds;
  MotionForm form;
  const LikenessWeights& weights;  ///< those of takes for a whole example: both are in one list
};

/// A stretch moved and cut so that it is in a track.
Stretch shifted_into(const Stretch& stretch, double length) {
  const double seconds = std::min(stretch.seconds(), length);
  const double begin = std::clamp(stretch.begin, 0.0, length - seconds);
  return {begin, begin + seconds};
}

/// Where the example fits best about a stretch of a track.
Stretch fitted(const Example& example, const PostureTrack& track, const Stretch& about) {
  // A quarter more on both sides may be better.
  const double margin = about.seconds() / 4;
  const Stretch region = {std::max(0.0, about.begin - margin),
                          std::min(whole_of(track).end, about.end + margin)};
  const auto rows_of = [](double seconds) {
    return static_cast<int>(std::lround(seconds * PostureConstants::rate)) + 1;
  };
  const int query_rows = std::clamp(rows_of(about.seconds()), 2, most_fitted_rows);
  const int target_rows = std::clamp(rows_of(region.seconds()), query_rows, 2 * query_rows);
  constexpr float bearing = LikenessConstants::bearing_taken_out;
  const ColumnRange fit =
      best_fit(row_distances(postures(*example.track, example.stretch, query_rows, bearing),
                             postures(track, region, target_rows, bearing)));
  const double step = region.seconds() / (target_rows - 1);
  return {region.begin + static_cast<double>(fit.begin) * step,
          region.begin + static_cast<double>(fit.end - 1) * step};
}

/// The best matches that do not share more than half of themselves with a better one.
std::vector<Match> best_places(std::vector<Match> matches, std::size_t count) {
  std::ranges::sort(matches, better);
  std::vector<Match> places;
  for (const Match& match : matches) {
    if (places.size() == count) break;
    const bool doubled = std::ranges::any_of(places, [&](const Match& place) {
      return place.take == match.take &&
             covered(match.stretch, place.stretch) > CandidateConstants::most_overlap;
    });
    if (!doubled) places.push_back(match);
  }
  return places;
}

/// Adds a stretch of a take near to the wanted one, and where the example fits best about it.
void compare_part(const PartExample& part, std::size_t take, const Stretch& wanted,
                  std::vector<Match>& matches) {
  const Example& example = part.example;
  const PostureTrack& track = part.library[take].track;
  const double length = whole_of(track).seconds();
  const Stretch about = shifted_into(wanted, length);
  // Where windows overlap, several candidates have one best fit: as they are, they may still be
  // occurrences of their own.
  for (const Stretch& stretch : {fitted(example, track, about), about}) {
    if (stretch.seconds() <= 0) continue;
    if (part.library[take].name == example.name && covered(stretch, example.stretch) > 0) continue;
    const int samples = static_cast<int>(part.form.rows.rows());
    double difference = unlikeness(part.form, motion_form(track, stretch, samples), part.weights);
    // A part of a take is less like a whole example than a take of its length.
    if (example.whole) {
      difference = std::hypot(difference, part_weight * std::log(length / part.seconds));
    }
    matches.push_back({take, stretch, difference, std::nullopt, false});
  }
}

/// Adds what lies about the best places, in their length and in the example's.
void look_about(const PartExample& part, std::vector<Match>& matches) {
  for (const Match& place : best_places(matches, places_looked_about)) {
    const double length = place.stretch.seconds();
    for (int step = -steps_looked_about; step <= steps_looked_about; ++step) {
      const double begin = place.stretch.begin + step * length / 2;
      compare_part(part, place.take, {begin, begin + length}, matches);
      compare_part(part, place.take, {begin, begin + part.seconds}, matches);
    }
  }
}

}  // namespace

std::vector<Match> part_matches(const std::vector<LibraryTake>& library, PlanGroup& group,
                                const Example& example, const std::vector<bool>& accept,
                                std::size_t count) {
  if (!group.windows) group.windows.emplace(tracks_of(library, group));
  const double seconds = seconds_of(example);
  const PartExample part = {library, example, seconds,
                            motion_form(*example.track, example.stretch, samples_for(seconds)),
                            example.whole ? take_weights : part_weights};
  std::vector<Match> matches;
  for (const Candidate& candidate :
       group.windows->find(*example.track, example.stretch, count, accept)) {
    compare_part(part, group.takes[candidate.track], candidate.stretch, matches);
  }
  if (!example.whole) look_about(part, matches);
  return matches;
}

}  // namespace reprise
