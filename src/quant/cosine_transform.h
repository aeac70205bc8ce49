// A take's curves as sums of cosines: one orthonormal transform (DCT-II) over the whole take.
#pragma once

#include <Eigen/Core>

namespace reprise {

/// Takes with more frames than this are not written as cosines: the way back takes time by frames
/// times numbers that are not zero.
constexpr long most_cosine_frames = 1 << 14;

/// Frames (rows) to frequencies, column by column: row k holds half-waves, k over the take.
void frames_to_cosines(Eigen::Ref<Eigen::MatrixXd> trajectories);
/// The inverse. Basic operations in one order alone: the same numbers on every machine.
void cosines_to_frames(Eigen::Ref<Eigen::MatrixXd> cosines);

}  // namespace reprise
