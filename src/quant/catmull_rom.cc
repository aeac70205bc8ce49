#include "quant/catmull_rom.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int most_levels = 12;

/// Numbers of one level: the even ones are coarser knots, the odd ones details.
class Level {
 public:
  Level(MatrixXd& matrix, Index stride) : matrix_(matrix), stride_(stride) {}

  Index count() const { return (matrix_.rows() + stride_ - 1) / stride_; }
  auto at(Index i) { return matrix_.row(i * stride_); }

  /// Half-way between the knots around odd `i`; past the ends the line through the last two goes
  /// on.
  Eigen::RowVectorXd midpoint(Index i) {
    const Index last = (count() - 1) / 2 * 2;
    if (i + 1 > last) {
      if (i < 3) return at(i - 1);
      return 1.5 * at(i - 1) - 0.5 * at(i - 3);
    }
    Eigen::RowVectorXd left = 2 * at(i - 1) - at(i + 1);
    Eigen::RowVectorXd right = 2 * at(i + 1) - at(i - 1);
    if (i >= 3) left = at(i - 3);
    if (i + 3 <= last) right = at(i + 3);
    return (9.0 / 16) * (at(i - 1) + at(i + 1)) - (1.0 / 16) * (left + right);
  }

  /// What the details around even `i` say of the coarser knot.
  Eigen::RowVectorXd correction(Index i) {
    const Index count_here = count();
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(matrix_.cols());
    if (i >= 1) sum += at(i - 1);
    if (i + 1 < count_here) sum += at(i + 1);
    return 0.25 * sum;
  }

 private:
  MatrixXd& matrix_;
  Index stride_;
};

/// Norm of what a unit detail of each level, and a unit coarsest knot, adds to a long trajectory.
struct KnotNorms {
  std::array<double, most_levels + 1> detail{};
  std::array<double, most_levels + 1> coarsest{};
};

void lift(MatrixXd& m, int levels) {
  for (int l = 0; l < levels; ++l) {
    Level level(m, Index{1} << l);
    for (Index i = 1; i < level.count(); i += 2) level.at(i) -= level.midpoint(i);
    for (Index i = 0; i < level.count(); i += 2) level.at(i) += level.correction(i);
  }
}

void unlift(MatrixXd& m, int levels) {
  for (int l = levels - 1; l >= 0; --l) {
    Level level(m, Index{1} << l);
    for (Index i = 0; i < level.count(); i += 2) level.at(i) -= level.correction(i);
    for (Index i = 1; i < level.count(); i += 2) level.at(i) += level.midpoint(i);
  }
}

const KnotNorms& knot_norms() {
  static const KnotNorms norms = [] {
    KnotNorms result;
    for (int l = 0; l <= most_levels; ++l) {
      const Index stride = Index{1} << l;
      if (l < most_levels) {
        MatrixXd impulse = MatrixXd::Zero(32 * stride, 1);
        impulse(15 * stride, 0) = 1;
        unlift(impulse, l + 1);
        result.detail[l] = impulse.norm();
      }
      MatrixXd impulse = MatrixXd::Zero(32 * stride, 1);
      impulse(16 * stride, 0) = 1;
      unlift(impulse, l);
      result.coarsest[l] = impulse.norm();
    }
    return result;
  }();
  return norms;
}

void scale(MatrixXd& m, int levels, bool inverse) {
  const KnotNorms& norms = knot_norms();
  for (Index i = 0; i < m.rows(); ++i) {
    const int level = knot_level(i, levels);
    const double norm = level == levels ? norms.coarsest[level] : norms.detail[level];
    m.row(i) *= inverse ? 1.0 / norm : norm;
  }
}

}  // namespace

int knot_level(long frame, int levels) {
  if (frame == 0) return levels;
  int level = 0;
  while (level < levels && (frame >> level & 1) == 0) ++level;
  return level;
}

int knot_levels(double frame_rate, long frames) {
  const double apart = std::max(1.0, coarsest_knot_seconds * frame_rate);
  int levels = std::clamp(static_cast<int>(std::lround(std::log2(apart))), 0, most_levels);
  while (levels > 0 && (Index{1} << levels) >= frames) --levels;
  return levels;
}

void NestedKnots::from_frames(MatrixXd& trajectories, int levels) {
  lift(trajectories, levels);
  scale(trajectories, levels, false);
}

void NestedKnots::to_frames(MatrixXd& knots, int levels) {
  scale(knots, levels, true);
  unlift(knots, levels);
}

}  // namespace reprise
