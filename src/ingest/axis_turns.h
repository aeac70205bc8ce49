// Angles of a joint that does not turn about three different axes: with one or two degrees of
// freedom, or a chain with repeated axes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ingest/marker_layout.h"

namespace reprise {

/// Turns the active ones of `rotations` so that E, the product of all turns, has a large trace of
/// target^T E: coordinate ascent, in a few sweeps, from where `angles` are (radians, a number a
/// channel). Writes the angles, continuous with what they were, and returns E.
Eigen::Matrix3d fit_axis_turns(const std::vector<RotationChannel>& rotations,
                               const Eigen::Matrix3d& target, std::vector<double>& angles);

}  // namespace reprise
