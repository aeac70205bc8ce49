// Which segments are the same behaviour (lin-2011 section 4.1): normalised cut of Shi and Malik.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rma/postures.h"

namespace reprise {

struct GroupConstants {
  double axes_share = 0.6;  ///< alpha of equation 1
  int axes = 5;             ///< K of equation 1
  /// w(p) halves from axis to axis, scaled to a sum of 1: about as the variance of the axes falls.
  /// The paper only says that it decreases.
  double axis_weight = 0.5;
  /// A group is parted while the normalised cut that does so costs less than this (of 2). The paper
  /// leaves it open. Measured (docs/findings/2026-11-25-behaviours.md).
  double most_cut = 0.8;
  /// Segments beyond this many join the group of the sampled ones they are most like, so that the
  /// matrix stays small.
  std::size_t most_sampled = 600;
};

/// What equation 1 compares of a segment.
struct SegmentShape {
  Eigen::MatrixXd axes;          ///< leading axes, columns; fewer where there are not as many
  Eigen::VectorXd mean_posture;  ///< of length 1
};

/// Samples of one segment.
SegmentShape segment_shape(const Eigen::Ref<const PostureMatrix>& postures,
                           const GroupConstants& constants = {});

/// Equation 1; an axis and its opposite are the same.
double segment_distance(const SegmentShape& a, const SegmentShape& b,
                        const GroupConstants& constants = {});

/// The group of each segment, counted from 0 in the order of their first segments. How many there
/// are is found.
std::vector<int> group_segments(std::span<const SegmentShape> segments,
                                const GroupConstants& constants = {});

}  // namespace reprise
