// Groups of clips that repeat one motion, over many takes: what a person asks for. Every member is
// held against its group's reference, so that chains do not join what is not alike.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rma/clip_alignment.h"
#include "rma/postures.h"
#include "rma/repeat_constants.h"
#include "rma/similar_posture_paths.h"

namespace reprise {

/// Takes that share a skeleton: postures at RepeatConstants::rate, and the same projected.
struct PostureLibrary {
  std::vector<PostureMatrix> postures;
  std::vector<PostureMatrix> projected;
  /// Of each sample: the distance (mm) from which on a posture is dissimilar, and the same for
  /// postures of another subject.
  std::vector<std::vector<float>> similar_mm;
  std::vector<std::vector<float>> similar_across_mm;
  /// Of each take; empty where all distances have the same limits.
  std::vector<std::string> subjects;

  PostureLibrary() = default;
  /// All samples have the limits of RepeatConstants.
  PostureLibrary(std::vector<PostureMatrix> takes, const RepeatConstants& constants);

  /// Lowers limits to RepeatConstants::reach_share of a sample's reach (posture_reaches).
  /// For libraries of many takes; in a single take that does one thing all is within reach.
  void narrow_to_reach(const RepeatConstants& constants);

  std::size_t takes() const { return postures.size(); }
  bool of_one_subject(std::size_t take, std::size_t other) const;
  /// The limits of a take's samples for postures of another take.
  const std::vector<float>& similar(std::size_t take, std::size_t other) const;
  /// One side of the plot of `take` beside another.
  PlotSide side(std::size_t take, std::size_t other) const {
    return {projected[take], similar(take, other)};
  }
  PostureView view(std::size_t take, long begin, long end) const;
};

/// Two places around which the motion may be alike. Who finds them is open: a library's index over
/// short windows, or every pixel of a small plot.
struct NearPair {
  std::uint32_t take = 0;
  std::int32_t sample = 0;
  std::uint32_t other_take = 0;
  std::int32_t other_sample = 0;

  friend auto operator<=>(const NearPair&, const NearPair&) = default;
};

/// Samples [begin, end) of a take; `distance_mm` is the mean joint distance to the group's
/// reference.
struct Occurrence {
  std::size_t take = 0;
  long begin = 0;
  long end = 0;
  float distance_mm = 0;
  /// Of each sample of the reference: the sample of this take beside it. Empty for the reference.
  std::vector<long> map{};
};

/// The reference first, at distance 0; then its repeats by take and time. No two overlap.
struct RepeatGroup {
  std::vector<Occurrence> occurrences;
};

/// Groups of at least two, those that explain most first. A clip may be in several groups: as a
/// part of a longer motion that recurs, or a longer one around it. With `only_take` the references
/// are clips of that take. `jobs` threads, 0: one a core; here and below, results do not depend
/// on it.
std::vector<RepeatGroup> find_repeat_groups(const PostureLibrary& library,
                                            std::span<const NearPair> near_pairs,
                                            std::optional<std::size_t> only_take,
                                            const RepeatConstants& constants, unsigned jobs = 1);
/// The same with references in the takes from `first_take` on.
std::vector<RepeatGroup> find_groups_from(const PostureLibrary& library,
                                          std::span<const NearPair> near_pairs,
                                          std::size_t first_take, const RepeatConstants& constants,
                                          unsigned jobs = 1);

/// The same, around given clips only: of each what repeats it, without looking for a better
/// reference. Clips that nothing repeats have no group.
std::vector<RepeatGroup> find_groups_of(const PostureLibrary& library,
                                        std::span<const NearPair> near_pairs,
                                        std::span<const Occurrence> clips,
                                        const RepeatConstants& constants, unsigned jobs = 1);

/// The repeats of one clip, by looking at all of the library; with the clip alone where there are
/// none.
RepeatGroup find_repeats_of(const PostureLibrary& library, const Occurrence& clip,
                            const RepeatConstants& constants, unsigned jobs = 1);

}  // namespace reprise
