// Which segments are the same behaviour (lin-2011 section 4.1): normalised cut of Shi and Malik.
#pragma once

#include <cstddef>
#include <cstdint>
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
  /// The dissimilarity threshold: a group is parted while its segments are further apart than this
  /// on average, and a segment joins a known group that is no further. Down to half of it they are
  /// parted where the normalised cut costs less than `most_cut` (of 2): two clusters with hardly
  /// anything in between. The paper leaves it open. Measured
  /// (docs/findings/2026-11-25-behaviours.md).
  double most_distance = 0.8;
  double least_distance = 0.4;
  double most_cut = 0.7;
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

/// A segment whose group stands.
struct KnownSegment {
  SegmentShape shape;
  std::int64_t group = 0;
};

/// The same beside groups that stand: a segment joins the one that it is nearest to on average, if
/// that is near enough; the rest are grouped among themselves, counted from `next_group` on.
std::vector<std::int64_t> join_groups(std::span<const SegmentShape> segments,
                                      std::span<const KnownSegment> known, std::int64_t next_group,
                                      const GroupConstants& constants = {});

}  // namespace reprise
