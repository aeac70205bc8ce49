// Groups of clips that repeat one motion, over many takes: what a person asks for. Every member is
// held against its group's reference, so that chains do not join what is not alike.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rma/group_members.h"
#include "rma/posture_library.h"
#include "rma/repeat_constants.h"

namespace reprise {

/// Two places around which the motion may be alike. Who finds them is open: a library's index over
/// short windows, or every pixel of a small plot.
struct NearPair {
  std::uint32_t take = 0;
  std::int32_t sample = 0;
  std::uint32_t other_take = 0;
  std::int32_t other_sample = 0;

  friend auto operator<=>(const NearPair&, const NearPair&) = default;
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
