// How far one rotation is from another.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "model/angle_units.h"

namespace reprise {

/// Squared Frobenius distance of two rotations: 8 sin^2 of half the angle between them. It is
/// cheap, and grows with the angle.
inline double squared_chord(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return (a - b).squaredNorm();
}

/// The squared chord of an angle in degrees, 0 to 180.
inline double squared_chord_of(double degrees) {
  const double sine = std::sin(std::min(degrees, 180.0) / 2 * radians_per_degree);
  return 8 * sine * sine;
}

/// The angle in degrees, 0 to 180, of a squared chord.
inline double degrees_of_chord(double squared) {
  return 2 * std::asin(std::sqrt(std::clamp(squared / 8, 0.0, 1.0))) * degrees_per_radian;
}

/// The geodesic angle between two rotations in degrees, 0 to 180.
inline double degrees_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return degrees_of_chord(squared_chord(a, b));
}

}  // namespace reprise
