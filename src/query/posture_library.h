// Decoded postures of an archive's takes, for what compares motion.
#pragma once

#include <functional>
#include <vector>

#include "query/archive_impl.h"
#include "rma/repeat_groups.h"

namespace reprise {

/// The takes of one skeleton, in the same order as their postures.
struct SkeletonPostures {
  std::vector<TakeInfo> takes;
  PostureLibrary library;
};

/// Decodes the coarsest layer of every one of `takes`, which share a skeleton whose root is `root`.
/// `tick` hears of each. Throws Error (damaged).
SkeletonPostures read_postures(OpenArchive& archive, std::vector<TakeInfo> takes,
                               const RootAxis& root, const RepeatConstants& constants,
                               const std::function<void(const TakeInfo&)>& tick);

}  // namespace reprise
