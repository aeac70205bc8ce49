// Decoded postures of an archive's takes, for what compares motion.
#pragma once

#include <functional>
#include <vector>

#include "query/archive_impl.h"
#include "rma/repeat_groups.h"

namespace reprise {

/// The takes of one skeleton, in the same order as their postures. People are of different sizes:
/// all postures are brought to the median size, each by its own factor.
struct SkeletonPostures {
  std::vector<TakeInfo> takes;
  std::vector<float> factors;
  PostureLibrary library;
};

/// Decodes the coarsest layer of every one of `takes`, which share a skeleton whose root is `root`.
/// `tick` hears of each, from one of `jobs` threads at a time (0: one a core). Throws Error
/// (damaged).
SkeletonPostures read_postures(OpenArchive& archive, std::vector<TakeInfo> takes,
                               const RootAxis& root, const RepeatConstants& constants,
                               unsigned jobs, const std::function<void(const TakeInfo&)>& tick);

/// Mean joint distance (mm) of an occurrence to the reference that its map belongs to, both in
/// their own sizes.
float own_size_distance(const SkeletonPostures& postures, const Occurrence& reference,
                        const Occurrence& occurrence);

}  // namespace reprise
