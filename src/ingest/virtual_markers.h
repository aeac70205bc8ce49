// Joint angles to virtual markers (lin-2011 section 3), on the reference proportions of a layout,
// so that actors of different size who do the same get the same markers.
#pragma once

#include <Eigen/Core>
#include <span>

#include "ingest/marker_layout.h"

namespace reprise {

/// frames x 3*markers, row-major, mm: places relative to the root joint, in its aligned frame; an
/// off-bone marker is relative to its joint's centre, so that an error of place does not look like
/// a twist.
using MarkerMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Markers of one frame. `channels` is a whole frame of the take, `root` the aligned orientation of
/// the root joint; `markers` receives layout.dimensions() numbers.
void place_markers(const MarkerLayout& layout, std::span<const double> channels,
                   const Eigen::Matrix3d& root, std::span<double> markers);

}  // namespace reprise
