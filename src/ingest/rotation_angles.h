// Rotation matrices and the angles that make them.
#pragma once

#include <Eigen/Core>
#include <array>

namespace reprise {

/// `angle` (radians) moved by whole turns next to `previous`.
double angle_next_to(double angle, double previous);

/// The proper rotation R with the largest trace of R^T matrix (Kabsch, A solution for the best
/// rotation to relate two sets of vectors, 1976). Of a matrix that fits many, one of them.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix);

/// Euler angles (radians) of a rotation about three different axes, outermost first.
using EulerAngles = std::array<double, 3>;

/// The two ways to write `rotation` as a product about `axes`, moved by whole turns next to
/// `previous`, the nearer first. Near gimbal lock the innermost angle stays at `previous`.
std::array<EulerAngles, 2> euler_angles(const Eigen::Matrix3d& rotation,
                                        const std::array<int, 3>& axes,
                                        const EulerAngles& previous);

/// The same rotation written so that it is continuous with `previous`.
EulerAngles nearest_euler_angles(const Eigen::Matrix3d& rotation, const std::array<int, 3>& axes,
                                 const EulerAngles& previous);

}  // namespace reprise
