// Which clips are worth asking for repeats of: the projections of similar-posture paths onto their
// takes (lin-2011 section 4.2.2).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rma/repeat_groups.h"

namespace reprise {

/// Samples [begin, end) of a take that paths project onto.
struct ClipExtent {
  std::size_t take = 0;
  long begin = 0;
  long end = 0;
  double support = 0;  ///< samples that repeat it, over all paths
};

/// Part that two half-open intervals have in common, of what they cover together.
double overlap_ratio(long begin_a, long end_a, long begin_b, long end_b);

/// Traces a path through every near pair that none has come through yet, and gathers its
/// projections; those that are nearly the same become one. Best supported first.
std::vector<ClipExtent> find_clip_extents(const PostureLibrary& library,
                                          std::span<const NearPair> near_pairs,
                                          const RepeatConstants& constants);

}  // namespace reprise
