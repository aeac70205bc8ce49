// Which clips are worth asking for repeats of: the projections of similar-posture paths onto their
// takes (lin-2011 section 4.2.2).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rma/repeat_groups.h"
#include "rma/similar_posture_paths.h"

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

/// A similar-posture path of two takes, or of one.
struct TracedPath {
  std::size_t take = 0;
  std::size_t other_take = 0;
  SimilarPath path;
};

/// A path through every near pair that none has come through yet, without those that are too short,
/// and without pairs that stand alone (RepeatConstants::next_near_s).
/// `jobs` threads, 0: one a core; here and below, results do not depend on it.
std::vector<TracedPath> trace_paths(const PostureLibrary& library,
                                    std::span<const NearPair> near_pairs,
                                    const RepeatConstants& constants, unsigned jobs = 1);

/// The projections of those paths; those that are nearly the same become one. Best supported first.
std::vector<ClipExtent> find_clip_extents(const PostureLibrary& library,
                                          std::span<const NearPair> near_pairs,
                                          const RepeatConstants& constants, unsigned jobs = 1);

}  // namespace reprise
