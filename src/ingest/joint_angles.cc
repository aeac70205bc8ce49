#include "ingest/joint_angles.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>
#include <numbers>

#include "ingest/virtual_markers.h"
#include "reprise/model/kinematics.h"

namespace reprise {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double pi = std::numbers::pi;
constexpr double degrees_per_radian = 180.0 / pi;
/// Cosine of the middle angle under which two outer angles cannot be told apart.
constexpr double gimbal_lock_cosine = 1e-5;
/// Sweeps over the angles of a joint with two degrees of freedom, or a chain with repeated axes.
constexpr int most_sweeps = 4;
constexpr double sweep_tolerance = 1e-7;

double next_to(double angle, double previous) {
  // Most frames move by less than half a turn, and rounding is slow.
  if (std::abs(previous - angle) < 3) return angle;
  return angle + 2 * pi * std::round((previous - angle) / (2 * pi));
}

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

/// Orthonormal axes with `first` along the first and `second` in the plane of the first two.
/// Vectors too short or too alike to say so (a coarse decode may bring any) get some axes all the
/// same.
Matrix3d basis(const Vector3d& first, const Vector3d& second) {
  constexpr double too_short = 1e-9;
  Matrix3d result;
  const double length = first.norm();
  result.col(0) = length > too_short ? Vector3d((1 / length) * first) : Vector3d::UnitX();
  Vector3d rest = second - second.dot(result.col(0)) * result.col(0);
  double rest_length = rest.norm();
  if (rest_length <= too_short) {
    rest = result.col(0).unitOrthogonal();
    rest_length = 1;
  }
  result.col(1) = (1 / rest_length) * rest;
  result.col(2) = result.col(0).cross(result.col(1));
  return result;
}

/// One target along the bone and one off it, which gives the turn about the bone.
bool off_bone_pair(const MarkerLayout& layout, const DrivenJoint& driven) {
  return driven.targets.size() == 2 && layout.markers[driven.targets[1].marker].off_bone;
}

/// A turn about a coordinate axis, by its cosine and sine.
struct AxisTurn {
  int axis = 0;
  double cosine = 1, sine = 0;

  int second() const { return (axis + 1) % 3; }
  int third() const { return (axis + 2) % 3; }

  /// R^T matrix.
  void undo_before(Matrix3d& matrix) const {
    const Eigen::RowVector3d row = matrix.row(second());
    matrix.row(second()) = cosine * row + sine * matrix.row(third());
    matrix.row(third()) = cosine * matrix.row(third()) - sine * row;
  }
  /// matrix R^T.
  void undo_after(Matrix3d& matrix) const {
    const Vector3d column = matrix.col(second());
    matrix.col(second()) = cosine * column - sine * matrix.col(third());
    matrix.col(third()) = cosine * matrix.col(third()) + sine * column;
  }
  /// matrix R.
  void follow(Matrix3d& matrix) const {
    const Vector3d column = matrix.col(second());
    matrix.col(second()) = cosine * column + sine * matrix.col(third());
    matrix.col(third()) = cosine * matrix.col(third()) - sine * column;
  }
  /// Becomes the turn with the largest trace of matrix^T R; returns how far it moved.
  double fit(const Matrix3d& matrix) {
    const double x = matrix(second(), second()) + matrix(third(), third());
    const double y = matrix(third(), second()) - matrix(second(), third());
    const double length = std::sqrt(x * x + y * y);
    if (!(length > 0)) return 0;
    const double moved = std::abs(x / length - cosine) + std::abs(y / length - sine);
    cosine = x / length;
    sine = y / length;
    return moved;
  }
};

/// Coordinate ascent on the trace of target^T E over the active angles, from where they are.
/// Returns E, the product of all turns.
Matrix3d ascend(const std::vector<RotationChannel>& rotations, const Matrix3d& target,
                std::vector<double>& angles) {
  const std::size_t count = rotations.size();
  std::vector<AxisTurn> turns(count);
  int active = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double angle = angles[rotations[k].channel];
    turns[k] = {rotations[k].axis, std::cos(angle), std::sin(angle)};
    active += rotations[k].active ? 1 : 0;
  }
  double moved = 1;
  for (int sweep = 0; sweep < (active > 1 ? most_sweeps : 1) && moved >= sweep_tolerance; ++sweep) {
    moved = 0;
    for (std::size_t k = 0; k < count; ++k) {
      if (!rotations[k].active) continue;
      Matrix3d seen = target;
      for (std::size_t i = 0; i < k; ++i) turns[i].undo_before(seen);
      for (std::size_t i = count; --i > k;) turns[i].undo_after(seen);
      moved += turns[k].fit(seen);
    }
  }
  Matrix3d product = Matrix3d::Identity();
  for (std::size_t k = 0; k < count; ++k) {
    turns[k].follow(product);
    double& angle = angles[rotations[k].channel];
    if (rotations[k].active) angle = next_to(std::atan2(turns[k].sine, turns[k].cosine), angle);
  }
  return product;
}

}  // namespace

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
    one[a] = next_to(one[a], previous[a]);
    two[a] = next_to(two[a], previous[a]);
  }
  if (distance(two, previous) < distance(one, previous)) std::swap(one, two);
  return {one, two};
}

EulerAngles nearest_euler_angles(const Matrix3d& rotation, const std::array<int, 3>& axes,
                                 const EulerAngles& previous) {
  return euler_angles(rotation, axes, previous)[0];
}

JointAngleSolver::JointAngleSolver(const MarkerLayout& layout, std::span<const double> start)
    : layout_(layout),
      angles_(start.begin(), start.end()),
      rotations_(layout.reference.joints.size(), Matrix3d::Identity()),
      positions_(layout.reference.joints.size(), Vector3d::Zero()),
      driven_of_joint_(layout.reference.joints.size(), -1) {
  for (double& angle : angles_) angle /= degrees_per_radian;
  for (std::size_t d = 0; d < layout.driven.size(); ++d) {
    const DrivenJoint& driven = layout.driven[d];
    driven_of_joint_[driven.joint] = static_cast<int>(d);
    const Matrix3d to_axes = layout.reference.joints[driven.joint].axis.transpose();
    TargetsAtRest rest;
    for (const OrientationTarget& target : driven.targets) {
      rest.directions.emplace_back(to_axes * target.local);
    }
    if (off_bone_pair(layout, driven)) {
      rest.to_basis = basis(rest.directions[0], rest.directions[1]).transpose();
    }
    at_rest_.push_back(std::move(rest));
  }
}

void JointAngleSolver::look_near(std::size_t index, std::span<const double> degrees) {
  const DrivenJoint& driven = layout_.driven[index];
  for (std::size_t k = 0; k < driven.rotations.size(); ++k) {
    angles_[driven.rotations[k].channel] = degrees[k] / degrees_per_radian;
  }
}

Matrix3d JointAngleSolver::seen_rotation(std::size_t index, std::span<const double> markers,
                                         const Matrix3d& to_local, const Vector3d& centre) const {
  const DrivenJoint& driven = layout_.driven[index];
  const TargetsAtRest& rest = at_rest_[index];
  const auto seen = [&](const OrientationTarget& target) -> Vector3d {
    const Vector3d place = Eigen::Map<const Vector3d>(markers.data() + 3 * target.marker);
    return to_local * (layout_.markers[target.marker].off_bone ? place : Vector3d(place - centre));
  };
  const auto& targets = driven.targets;
  if (off_bone_pair(layout_, driven)) {
    return basis(seen(targets[0]), seen(targets[1])) * rest.to_basis;
  }
  Matrix3d correlation = Matrix3d::Zero();
  for (std::size_t t = 0; t < targets.size(); ++t) {
    correlation += seen(targets[t]) * rest.directions[t].transpose();
  }
  return targets.size() > 1 ? nearest_rotation(correlation) : correlation;
}

Matrix3d JointAngleSolver::solve_joint(std::size_t index, std::span<const double> markers,
                                       const Matrix3d& parent, const Vector3d& centre,
                                       std::span<double> channels) {
  const DrivenJoint& driven = layout_.driven[index];
  // Joints of a BVH have no axes of their own.
  const bool has_axis = layout_.reference.format == MotionFormat::asf_amc;
  const Matrix3d& axis = layout_.reference.joints[driven.joint].axis;
  const Matrix3d to_world = has_axis ? Matrix3d(parent * axis) : parent;
  Matrix3d local = seen_rotation(index, markers, to_world.transpose(), centre);
  if (turns_about_three_axes(driven.rotations)) {
    const auto& r = driven.rotations;
    const EulerAngles previous = {angles_[r[0].channel], angles_[r[1].channel],
                                  angles_[r[2].channel]};
    const EulerAngles now =
        nearest_euler_angles(local, {r[0].axis, r[1].axis, r[2].axis}, previous);
    for (int k = 0; k < 3; ++k) angles_[r[k].channel] = now[k];
  } else {
    local = ascend(driven.rotations, local, angles_);
  }
  for (const RotationChannel& rotation : driven.rotations) {
    channels[rotation.channel] = angles_[rotation.channel] * degrees_per_radian;
  }
  const Matrix3d turned = to_world * local;
  return has_axis ? Matrix3d(turned * axis.transpose()) : turned;
}

Matrix3d JointAngleSolver::solve(std::span<const double> markers, const Matrix3d* known_root,
                                 std::span<double> channels) {
  const auto& joints = layout_.reference.joints;
  const bool asf = layout_.reference.format == MotionFormat::asf_amc;
  const auto root = static_cast<std::size_t>(layout_.choices.root_joint);
  for (const int channel : layout_.direct_channels) {
    angles_[channel] = channels[channel] / degrees_per_radian;
  }
  for (std::size_t j = root; j < joints.size(); ++j) {
    if (!layout_.under_root[j]) continue;
    const int d = driven_of_joint_[j];
    if (j == root) {
      rotations_[j].setIdentity();
      if (known_root != nullptr) {
        rotations_[j] = *known_root;
      } else if (d >= 0) {
        // Seen without the root's own axes: its channels are found once the heading is known.
        const Matrix3d& axis = joints[j].axis;
        rotations_[j] = axis *
                        seen_rotation(static_cast<std::size_t>(d), markers, axis.transpose(),
                                      Vector3d::Zero()) *
                        axis.transpose();
      }
      continue;
    }
    const Matrix3d& parent = rotations_[joints[j].parent];
    const Vector3d& parent_place = positions_[joints[j].parent];
    const Vector3d centre =
        asf ? parent_place : Vector3d(parent_place + parent * layout_.offsets[j]);
    if (d >= 0) {
      rotations_[j] = solve_joint(static_cast<std::size_t>(d), markers, parent, centre, channels);
    } else {
      Matrix3d local = Matrix3d::Identity();
      for (const RotationChannel& rotation : rotation_channels(joints[j])) {
        local *= axis_rotation(rotation.axis, angles_[rotation.channel]);
      }
      rotations_[j] = parent * joints[j].axis * local * joints[j].axis.transpose();
    }
    positions_[j] = asf ? Vector3d(parent_place + rotations_[j] * layout_.offsets[j]) : centre;
  }
  return rotations_[root];
}

}  // namespace reprise
