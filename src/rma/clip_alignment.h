// Where a take does what a clip does, at whatever speed.
#pragma once

#include <vector>

#include "rma/postures.h"
#include "rma/repeat_constants.h"

namespace reprise {

/// A part of a take, half-open, in samples, aligned to a reference clip.
struct AlignedClip {
  long begin = 0;
  long end = 0;
  float mean_mm = 0;      ///< mean joint distance to the reference along the alignment
  std::vector<long> map;  ///< of each sample of the reference: the sample of the take beside it
};

/// A clip of postures, and the same projected.
struct PostureView {
  Eigen::Ref<const PostureMatrix> postures;
  Eigen::Ref<const PostureMatrix> projected;
};

/// The places in `take` that are like the whole of `clip`: ends of least-cost alignments whose mean
/// joint distance is at most `most_mm`, better ones first, none overlapping a better one. The
/// distance is a mean over the samples of the clip. The alignment runs at 1/3 to 3 times the clip's
/// speed.
std::vector<AlignedClip> align_clip(const PostureView& clip, const PostureView& take,
                                    float most_mm);

}  // namespace reprise
