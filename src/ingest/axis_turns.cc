#include "ingest/axis_turns.h"

#include <cmath>

#include "ingest/rotation_angles.h"

namespace reprise {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int most_sweeps = 4;
constexpr double sweep_tolerance = 1e-7;

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

}  // namespace

Matrix3d fit_axis_turns(const std::vector<RotationChannel>& rotations, const Matrix3d& target,
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
    if (rotations[k].active)
      angle = angle_next_to(std::atan2(turns[k].sine, turns[k].cosine), angle);
  }
  return product;
}

}  // namespace reprise
