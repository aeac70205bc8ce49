#include "reprise/query/motion_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "query/candidate_windows.h"
#include "query/motion_library.h"
#include "query/take_ranking.h"
#include "reprise/error.h"

namespace reprise {
namespace {

/// Stretches that are compared in full for each search; more if more are asked for.
constexpr std::size_t least_compared = 300;
/// A take longer than this many times the example is searched for parts.
constexpr double longest_whole = 2.0;
/// mm that a factor e between a take's length and that of a whole example counts against its parts.
constexpr double part_weight = 100.0;
/// Motion that recurs does so next to itself more often than elsewhere: about this many of the best
/// places of a part, so many steps of half a length to both sides are looked at as well.
constexpr std::size_t places_looked_about = 12;
constexpr int steps_looked_about = 2;
/// Rows of the example when its place in a take is looked for.
constexpr int most_fitted_rows = 64;

/// Takes of one plan, and what is made for them when it is first needed.
struct PlanGroup {
  std::vector<std::size_t> takes;
  std::optional<TakeRanking> ranking;
  std::optional<CandidateWindows> windows;
};

struct Example {
  const PostureTrack* track = nullptr;
  Stretch stretch;
  bool whole = true;
  std::string name;  ///< of the archive's take, else empty
  std::string subject;
};

/// A stretch that was compared in full.
struct Match {
  std::size_t take = 0;
  Stretch stretch;
  double unlikeness = 0;
};

bool better(const Match& a, const Match& b) {
  return std::tuple(a.unlikeness, a.take, a.stretch.begin) <
         std::tuple(b.unlikeness, b.take, b.stretch.begin);
}

/// An example of which parts are compared.
struct PartExample {
  const Example& example;
  double seconds;
  MotionForm form;
};

Stretch whole_of(const PostureTrack& track) {
  return {0, static_cast<double>(track.frames() - 1) / PostureConstants::rate};
}

/// Not zero, for an example of a single frame.
double seconds_of(const Example& example) {
  return std::max(example.stretch.seconds(), 1 / PostureConstants::rate);
}

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
  const RowRange fit = best_fit(postures(*example.track, example.stretch, query_rows, bearing),
                                postures(track, region, target_rows, bearing));
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

}  // namespace

struct MotionSearch::Impl {
  std::vector<LibraryTake> takes;
  JointMap joint_map;
  std::map<std::uint64_t, PlanGroup> groups;

  PlanGroup& group_of(const PostureTrack& track);
  std::vector<const PostureTrack*> tracks_of(const PlanGroup& group) const;
  std::vector<bool> accepted(const PlanGroup& group, const Example& example,
                             const SearchOptions& options) const;
  std::vector<Match> whole_matches(PlanGroup& group, const Example& example,
                                   const std::vector<bool>& accept, std::size_t count) const;
  std::vector<Match> part_matches(PlanGroup& group, const Example& example,
                                  const std::vector<bool>& accept, std::size_t count) const;
  void compare_part(const PartExample& part, std::size_t take, const Stretch& wanted,
                    std::vector<Match>& matches) const;
  void look_about(const PartExample& part, std::vector<Match>& matches) const;
  std::vector<Match> matches_of(PlanGroup& group, const Example& example,
                                const std::vector<bool>& accept, std::size_t count) const;
  std::vector<SearchResult> search(const Example& example, const SearchOptions& options);
};

PlanGroup& MotionSearch::Impl::group_of(const PostureTrack& track) {
  const auto group = groups.find(track.plan.id);
  if (group == groups.end()) {
    throw Error(ErrorCode::not_found, "no take has a body that the example's can be compared with",
                {}, "say which joints are which with --joint-map");
  }
  return group->second;
}

std::vector<const PostureTrack*> MotionSearch::Impl::tracks_of(const PlanGroup& group) const {
  std::vector<const PostureTrack*> tracks;
  for (const std::size_t take : group.takes) tracks.push_back(&takes[take].track);
  return tracks;
}

std::vector<bool> MotionSearch::Impl::accepted(const PlanGroup& group, const Example& example,
                                               const SearchOptions& options) const {
  std::vector<bool> accept;
  for (const std::size_t i : group.takes) {
    const bool same_take = !example.name.empty() && takes[i].name == example.name;
    const bool same_subject = !example.subject.empty() && takes[i].subject == example.subject;
    accept.push_back(!(same_take && example.whole) && !(options.across_subjects && same_subject));
  }
  return accept;
}

std::vector<Match> MotionSearch::Impl::whole_matches(PlanGroup& group, const Example& example,
                                                     const std::vector<bool>& accept,
                                                     std::size_t count) const {
  if (!group.ranking) group.ranking.emplace(tracks_of(group));
  const double seconds = seconds_of(example);
  const int samples = samples_for(seconds);
  const MotionForm form = motion_form(*example.track, example.stretch, samples);
  std::vector<Match> matches;
  for (const std::size_t i : group.ranking->nearest(*example.track, count, accept)) {
    const std::size_t take = group.takes[i];
    const Stretch stretch = whole_of(takes[take].track);
    matches.push_back(
        {take, stretch, unlikeness(form, motion_form(takes[take].track, stretch, samples))});
  }
  return matches;
}

/// Adds a stretch of a take near to the wanted one, and where the example fits best about it.
void MotionSearch::Impl::compare_part(const PartExample& part, std::size_t take,
                                      const Stretch& wanted, std::vector<Match>& matches) const {
  const Example& example = part.example;
  const PostureTrack& track = takes[take].track;
  const double length = whole_of(track).seconds();
  const Stretch about = shifted_into(wanted, length);
  // Where windows overlap, several candidates have one best fit: as they are, they may still be
  // occurrences of their own.
  for (const Stretch& stretch : {fitted(example, track, about), about}) {
    if (stretch.seconds() <= 0) continue;
    if (takes[take].name == example.name && covered(stretch, example.stretch) > 0) continue;
    const int samples = static_cast<int>(part.form.rows.rows());
    double difference = unlikeness(part.form, motion_form(track, stretch, samples));
    // A part of a take is less like a whole example than a take of its length.
    if (example.whole) {
      difference = std::hypot(difference, part_weight * std::log(length / part.seconds));
    }
    matches.push_back({take, stretch, difference});
  }
}

/// Adds what lies about the best places, in their length and in the example's.
void MotionSearch::Impl::look_about(const PartExample& part, std::vector<Match>& matches) const {
  for (const Match& place : best_places(matches, places_looked_about)) {
    const double length = place.stretch.seconds();
    for (int step = -steps_looked_about; step <= steps_looked_about; ++step) {
      const double begin = place.stretch.begin + step * length / 2;
      compare_part(part, place.take, {begin, begin + length}, matches);
      compare_part(part, place.take, {begin, begin + part.seconds}, matches);
    }
  }
}

std::vector<Match> MotionSearch::Impl::part_matches(PlanGroup& group, const Example& example,
                                                    const std::vector<bool>& accept,
                                                    std::size_t count) const {
  if (!group.windows) group.windows.emplace(tracks_of(group));
  const double seconds = seconds_of(example);
  const PartExample part = {example, seconds,
                            motion_form(*example.track, example.stretch, samples_for(seconds))};
  std::vector<Match> matches;
  for (const Candidate& candidate :
       group.windows->find(*example.track, example.stretch, count, accept)) {
    compare_part(part, group.takes[candidate.track], candidate.stretch, matches);
  }
  if (!example.whole) look_about(part, matches);
  return matches;
}

std::vector<Match> MotionSearch::Impl::matches_of(PlanGroup& group, const Example& example,
                                                  const std::vector<bool>& accept,
                                                  std::size_t count) const {
  if (!example.whole) return part_matches(group, example, accept, count);
  std::vector<Match> matches = whole_matches(group, example, accept, count);
  std::vector<bool> long_takes = accept;
  for (std::size_t i = 0; i < accept.size(); ++i) {
    const double other = whole_of(takes[group.takes[i]].track).seconds();
    long_takes[i] = accept[i] && other > longest_whole * seconds_of(example);
  }
  if (std::ranges::find(long_takes, true) != long_takes.end()) {
    const std::vector<Match> parts = part_matches(group, example, long_takes, count);
    matches.insert(matches.end(), parts.begin(), parts.end());
  }
  return matches;
}

std::vector<SearchResult> MotionSearch::Impl::search(const Example& example,
                                                     const SearchOptions& options) {
  PlanGroup& group = group_of(*example.track);
  const std::vector<bool> accept = accepted(group, example, options);
  std::vector<Match> matches =
      matches_of(group, example, accept, std::max(least_compared, options.top));
  std::ranges::sort(matches, better);
  std::vector<SearchResult> results;
  std::map<std::size_t, std::vector<Stretch>> found;
  for (const Match& match : matches) {
    if (results.size() == options.top) break;
    std::vector<Stretch>& others = found[match.take];
    const auto covers = [&](const Stretch& other) {
      return !options.all_occurrences ||
             covered(match.stretch, other) > CandidateConstants::most_overlap;
    };
    if (std::ranges::any_of(others, covers)) continue;
    const LibraryTake& take = takes[match.take];
    const double distance =
        mean_joint_distance(*example.track, example.stretch, take.track, match.stretch);
    if (options.limit_mm && distance > *options.limit_mm) continue;
    others.push_back(match.stretch);
    results.push_back({take.name, take.subject, match.stretch.begin, match.stretch.end, distance,
                       match.unlikeness});
  }
  return results;
}

namespace {

/// The part of an example that the options ask for. Throws Error (usage).
void choose_part(Example& example, double seconds, const SearchOptions& options) {
  const double from = options.from.value_or(0.0), to = options.to.value_or(seconds);
  if (!(from >= 0) || !(from < to) || !(to <= seconds + 1e-6)) {
    throw Error(ErrorCode::usage, "--from and --to are not a part of the example, which has " +
                                      std::to_string(seconds) + " s");
  }
  example.whole = !options.from && !options.to;
  const Stretch whole = whole_of(*example.track);
  example.stretch = {std::min(from, whole.end), std::min(to, whole.end)};
}

}  // namespace

MotionSearch::MotionSearch(const std::filesystem::path& archive, const SearchSetup& setup,
                           const ProgressSink& progress)
    : impl_(std::make_unique<Impl>()) {
  impl_->joint_map = setup.joint_map;
  const std::filesystem::path cache = search_cache_path(archive);
  impl_->takes = read_library(archive, setup, read_feature_cache(cache), progress);
  if (setup.write_cache) {
    const Digest content = ArchiveStore::open_for_reading(archive).content_digest();
    if (content_of_cache(cache) != content) write_feature_cache(cache, content, impl_->takes);
  }
  for (std::size_t i = 0; i < impl_->takes.size(); ++i) {
    impl_->groups[impl_->takes[i].track.plan.id].takes.push_back(i);
  }
}

MotionSearch::~MotionSearch() = default;
MotionSearch::MotionSearch(MotionSearch&&) noexcept = default;
MotionSearch& MotionSearch::operator=(MotionSearch&&) noexcept = default;

std::vector<SearchResult> MotionSearch::like(const Take& take, const SearchOptions& options) {
  const PostureTrack track = posture_track(take, impl_->joint_map);
  Example example;
  example.track = &track;
  choose_part(example, take.seconds(), options);
  return impl_->search(example, options);
}

std::vector<SearchResult> MotionSearch::like(const TakeInfo& take, const SearchOptions& options) {
  const auto known = std::ranges::find(impl_->takes, take.name, &LibraryTake::name);
  if (known == impl_->takes.end()) {
    throw Error(ErrorCode::not_found, "there is no take '" + take.name + "'");
  }
  Example example;
  example.track = &known->track;
  example.name = known->name;
  example.subject = known->subject;
  choose_part(example, take.seconds(), options);
  return impl_->search(example, options);
}

}  // namespace reprise
