#include "ingest/rotation_angles.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "reprise/model/kinematics.h"

namespace reprise {
namespace {

using Eigen::Matrix3d;

constexpr double pi = std::numbers::pi;
/// Cosine of the middle angle under which two outer angles cannot be told apart.
constexpr double gimbal_lock_cosine = 1e-5;

double distance(const EulerAngles& a, const EulerAngles& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

/// The angle about `axis` that turns best into `matrix`: the largest trace of matrix^T R.
double best_angle(const Matrix3d& matrix, int axis) {
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  return std::atan2(matrix(k, j) - matrix(j, k), matrix(j, j) + matrix(k, k));
}

/// The inverse's transpose, times the determinant.
Matrix3d cofactor_matrix(const Matrix3d& matrix) {
  Matrix3d result;
  result.col(0) = matrix.col(1).cross(matrix.col(2));
  result.col(1) = matrix.col(2).cross(matrix.col(0));
  result.col(2) = matrix.col(0).cross(matrix.col(1));
  return result;
}

/// The mean of a matrix and its inverse's transpose, again and again, brings the singular values to
/// 1 and leaves the directions (Higham, Computing the polar decomposition, 1986). False if it did
/// not get there.
bool iterate_to_rotation(Matrix3d& matrix) {
  constexpr int most_steps = 12;
  constexpr double close_enough = 1e-14;
  for (int step = 0; step < most_steps; ++step) {
    const Matrix3d cofactors = cofactor_matrix(matrix);
    const double determinant = matrix.col(0).dot(cofactors.col(0));
    const double inverse_norm = cofactors.squaredNorm() / (determinant * determinant);
    // Scaled so that the first steps are as quick as the last.
    const double scale = std::sqrt(std::sqrt(inverse_norm / matrix.squaredNorm()));
    const Matrix3d next = (0.5 * scale) * matrix + (0.5 / (scale * determinant)) * cofactors;
    const double moved = (next - matrix).squaredNorm();
    matrix = next;
    if (!(moved > close_enough)) return std::isfinite(moved);
  }
  return false;
}

}  // namespace

double angle_next_to(double angle, double previous) {
  // Most frames move by less than half a turn, and rounding is slow.
  if (std::abs(previous - angle) < 3) return angle;
  return angle + 2 * pi * std::round((previous - angle) / (2 * pi));
}

Matrix3d nearest_rotation(const Matrix3d& matrix) {
  // With its cofactors added, a plane gets the normal that makes it proper, and a reflection turns
  // into a rotation along its weakest direction.
  const double norm = matrix.norm();
  Matrix3d proper = matrix + cofactor_matrix(matrix) / norm;
  constexpr double clearly_proper = 1e-4;
  if (proper.determinant() > clearly_proper * norm * norm * norm && iterate_to_rotation(proper)) {
    return proper;
  }
  const Eigen::JacobiSVD<Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d sign = Matrix3d::Identity();
  sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  return svd.matrixU() * sign * svd.matrixV().transpose();
}

std::array<EulerAngles, 2> euler_angles(const Matrix3d& rotation, const std::array<int, 3>& axes,
                                        const EulerAngles& previous) {
  const auto [i, j, k] = axes;
  const double sign = (i + 1) % 3 == j ? 1 : -1;
  const double sine = std::clamp(sign * rotation(i, k), -1.0, 1.0);
  const double cosine =
      std::sqrt(rotation(i, i) * rotation(i, i) + rotation(i, j) * rotation(i, j));
  EulerAngles one;
  one[1] = std::atan2(sine, cosine);
  if (cosine < gimbal_lock_cosine) {
    one[2] = previous[2];
    const Matrix3d rest = rotation * axis_rotation(k, -one[2]) * axis_rotation(j, -one[1]);
    one[0] = best_angle(rest, i);
  } else {
    one[0] = std::atan2(-sign * rotation(j, k), rotation(k, k));
    one[2] = std::atan2(-sign * rotation(i, j), rotation(i, i));
  }
  EulerAngles two = {one[0] + pi, pi - one[1], one[2] + pi};
  for (int a = 0; a < 3; ++a) {
    one[a] = angle_next_to(one[a], previous[a]);
    two[a] = angle_next_to(two[a], previous[a]);
  }
  if (distance(two, previous) < distance(one, previous)) std::swap(one, two);
  return {one, two};
}

EulerAngles nearest_euler_angles(const Matrix3d& rotation, const std::array<int, 3>& axes,
                                 const EulerAngles& previous) {
  return euler_angles(rotation, axes, previous)[0];
}

}  // namespace reprise
