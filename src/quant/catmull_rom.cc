#include "quant/catmull_rom.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Enough for half a second at 500 frames a second.
constexpr int most_levels = 8;

/// Numbers of one level of one trajectory: the even ones are coarser knots, the odd ones details.
class Level {
 public:
  Level(double* values, Index frames, Index stride)
      : values_(values), stride_(stride), count_((frames + stride - 1) / stride) {}

  Index count() const { return count_; }
  double& at(Index i) { return values_[i * stride_]; }

  /// Half-way between the knots around odd `i`; past the ends the line through the last two goes
  /// on.
  double midpoint(Index i) {
    const Index last = (count_ - 1) / 2 * 2;
    if (i + 1 > last) return i < 3 ? at(i - 1) : 1.5 * at(i - 1) - 0.5 * at(i - 3);
    const double near = at(i - 1) + at(i + 1);
    return (75.0 / 128) * near - (25.0 / 256) * (knot(i - 3, last) + knot(i + 3, last)) +
           (3.0 / 256) * (knot(i - 5, last) + knot(i + 5, last));
  }

  /// What the details around even `i` say of the coarser knot.
  double correction(Index i) {
    return (9.0 / 32) * (detail(i - 1) + detail(i + 1)) -
           (1.0 / 32) * (detail(i - 3) + detail(i + 3));
  }

 private:
  double knot(Index i, Index last) {
    if (i < 0) return at(0) + static_cast<double>(-i / 2) * (at(0) - at(2));
    if (i > last) return at(last) + static_cast<double>((i - last) / 2) * (at(last) - at(last - 2));
    return at(i);
  }
  double detail(Index i) { return i >= 0 && i < count_ ? at(i) : 0.0; }

  double* values_;
  Index stride_;
  Index count_;
};

/// Norm of what a unit detail of each level, and a unit coarsest knot, adds to a long trajectory.
struct KnotNorms {
  std::array<double, most_levels + 1> detail{};
  std::array<double, most_levels + 1> coarsest{};
};

void lift(MatrixXd& m, int levels) {
  for (Index column = 0; column < m.cols(); ++column) {
    for (int l = 0; l < levels; ++l) {
      Level level(m.col(column).data(), m.rows(), Index{1} << l);
      for (Index i = 1; i < level.count(); i += 2) level.at(i) -= level.midpoint(i);
      for (Index i = 0; i < level.count(); i += 2) level.at(i) += level.correction(i);
    }
  }
}

void unlift(MatrixXd& m, int levels) {
  for (Index column = 0; column < m.cols(); ++column) {
    for (int l = levels - 1; l >= 0; --l) {
      Level level(m.col(column).data(), m.rows(), Index{1} << l);
      for (Index i = 0; i < level.count(); i += 2) level.at(i) -= level.correction(i);
      for (Index i = 1; i < level.count(); i += 2) level.at(i) += level.midpoint(i);
    }
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
