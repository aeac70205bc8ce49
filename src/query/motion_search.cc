#include "reprise/query/motion_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "query/part_search.h"
#include "query/whole_search.h"
#include "reprise/error.h"
#include "rma/repeat_constants.h"

namespace reprise {
namespace {

/// Stretches that are compared in full for each search; more if more are asked for.
constexpr std::size_t least_compared = 300;
/// A repeat is as near as what `repeats` tells (LibraryReach::repeat_limit), at no more than so
/// many times another speed, and within this part of the size of either motion: what hardly moves
/// is near to all else that hardly moves. Takes and parts that are as unlike as this (mm) do other
/// things with the same postures. Measured (docs/findings/2026-12-01-one-meaning-of-repeated.md).
constexpr double repeat_speed = RepeatConstants::steepest;
constexpr double repeat_part_of_size = 0.45;
constexpr double repeat_unlikeness = 200;
/// A take longer than this many times the example is searched for parts.
constexpr double longest_whole = 2.0;

/// Postures are sampled: the last one of a take stands for what is left of it.
double told_end(const LibraryTake& take, const Stretch& stretch) {
  const bool to_the_last = stretch.end >= whole_of(take.track).end;
  return to_the_last ? std::max(take.seconds, stretch.end) : stretch.end;
}

}  // namespace

struct MotionSearch::Impl {
  std::vector<LibraryTake> takes;
  JointMap joint_map;
  std::string cache_problem;
  std::map<std::uint64_t, PlanGroup> groups;

  /// Writes the cache, unless it is as the archive is already.
  void keep(const std::filesystem::path& archive, const std::filesystem::path& cache);
  std::vector<bool> accepted(const PlanGroup& group, const Example& example,
                             const SearchOptions& options) const;
  std::vector<Match> matches_of(PlanGroup& group, const Example& example,
                                const std::vector<bool>& accept, std::size_t count) const;
  /// Says which matches repeat the example, and how far these are from it.
  void find_repeats(PlanGroup& group, const Example& example, std::vector<Match>& matches) const;
  std::vector<SearchResult> search(const Example& example, const SearchOptions& options);
};

void MotionSearch::Impl::keep(const std::filesystem::path& archive,
                              const std::filesystem::path& cache) {
  const Digest content = ArchiveStore::open_for_reading(archive).content_digest();
  if (content_of_cache(cache) == content) return;
  try {
    write_feature_cache(cache, content, takes);
  } catch (const Error& error) {
    cache_problem = error.what();
  }
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

std::vector<Match> MotionSearch::Impl::matches_of(PlanGroup& group, const Example& example,
                                                  const std::vector<bool>& accept,
                                                  std::size_t count) const {
  if (!example.whole) return part_matches(takes, group, example, accept, count);
  std::vector<Match> matches = whole_matches(takes, group, example, accept, count);
  std::vector<bool> long_takes = accept;
  for (std::size_t i = 0; i < accept.size(); ++i) {
    const double other = whole_of(takes[group.takes[i]].track).seconds();
    long_takes[i] = accept[i] && other > longest_whole * seconds_of(example);
  }
  if (std::ranges::find(long_takes, true) != long_takes.end()) {
    const std::vector<Match> parts = part_matches(takes, group, example, long_takes, count);
    matches.insert(matches.end(), parts.begin(), parts.end());
  }
  return matches;
}

void MotionSearch::Impl::find_repeats(PlanGroup& group, const Example& example,
                                      std::vector<Match>& matches) const {
  if (!group.reach) group.reach.emplace(tracks_of(takes, group));
  const double seconds = example.stretch.seconds();
  const double size = motion_size(*example.track, example.stretch);
  const double limit = std::min(group.reach->repeat_limit(*example.track, example.stretch),
                                repeat_part_of_size * size);
  for (Match& match : matches) {
    const PostureTrack& track = takes[match.take].track;
    const double other = match.stretch.seconds();
    const bool in_longer = example.whole && other < whole_of(track).seconds();
    const bool other_speed = std::max(seconds, other) > repeat_speed * std::min(seconds, other);
    if (other_speed || (!in_longer && match.unlikeness > repeat_unlikeness)) continue;
    match.distance_mm = mean_joint_distance(*example.track, example.stretch, track, match.stretch);
    match.repeat = match.distance_mm <= limit &&
                   match.distance_mm <= repeat_part_of_size * motion_size(track, match.stretch);
  }
}

std::vector<SearchResult> MotionSearch::Impl::search(const Example& example,
                                                     const SearchOptions& options) {
  const auto known = groups.find(example.track->plan.id);
  if (known == groups.end()) return {};
  PlanGroup& group = known->second;
  const std::vector<bool> accept = accepted(group, example, options);
  std::vector<Match> matches =
      matches_of(group, example, accept, std::max(least_compared, options.top));
  find_repeats(group, example, matches);
  std::ranges::sort(matches, comes_before);
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
    const double distance = match.distance_mm ? *match.distance_mm
                                              : mean_joint_distance(*example.track, example.stretch,
                                                                    take.track, match.stretch);
    if (options.limit_mm && distance > *options.limit_mm) continue;
    others.push_back(match.stretch);
    results.push_back({take.name, take.subject, match.stretch.begin, told_end(take, match.stretch),
                       distance, match.unlikeness, match.repeat});
  }
  return results;
}

namespace {

/// The part of an example that the options ask for. Throws Error (usage).
void choose_part(Example& example, double seconds, const SearchOptions& options) {
  const double from = options.from.value_or(0.0), to = options.to.value_or(seconds);
  if (!(from >= 0) || !(from < to) || !(to <= seconds + 1e-6)) {
    const auto side = [](const std::optional<double>& time) {
      return time ? fmt::format("{:g}", *time) : std::string();
    };
    throw Error(ErrorCode::usage,
                fmt::format("{}:{} s are not within 0:{:g} s, which is what there is",
                            side(options.from), side(options.to), seconds));
  }
  example.whole = !options.from && !options.to;
  const Stretch whole = whole_of(*example.track);
  example.stretch = {std::min(from, whole.end), std::min(to, whole.end)};
  constexpr double least_seconds = 2 / PostureConstants::rate;  // three postures, as in repeats
  if (!example.whole && example.stretch.seconds() < least_seconds) {
    throw Error(ErrorCode::usage, "the part is too short to look for its motion");
  }
}

}  // namespace

MotionSearch::MotionSearch(const std::filesystem::path& archive, const SearchSetup& setup,
                           const ProgressSink& progress)
    : impl_(std::make_unique<Impl>()) {
  impl_->joint_map = setup.joint_map;
  const std::filesystem::path cache = search_cache_path(archive);
  impl_->takes = read_library(archive, setup, read_feature_cache(cache), progress);
  if (setup.write_cache) impl_->keep(archive, cache);
  for (std::size_t i = 0; i < impl_->takes.size(); ++i) {
    impl_->groups[impl_->takes[i].track.plan.id].takes.push_back(i);
  }
}

const std::string& MotionSearch::cache_problem() const { return impl_->cache_problem; }

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
