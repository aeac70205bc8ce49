#include "refine/knot_rounding.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace reprise {
namespace {

using Eigen::Index;

/// A knot below one step is rounded up from 0.5 + this part of its step on, as zeros cost least; by
/// up to `quiet_zone` more the smaller the knots around it are, as there they cost next to nothing.
/// What was tried: docs/findings/2026-11-26-coarse-channels.md.
constexpr double dead_zone = 0.08, quiet_zone = 0.2;
/// The same of larger knots, for which one less is only a little cheaper.
constexpr double large_dead_zone = 0.04;

class KnotRounder {
 public:
  KnotRounder(const Eigen::VectorXd& values, std::size_t place, CodedChannels& coded)
      : values_(values),
        place_(place),
        column_(static_cast<Index>(place)),
        above_(coded.shape.parents[place]),
        coded_(coded) {}

  bool run() {
    const int levels = coded_.shape.levels;
    const Index frames = coded_.shape.frames, stride = Index{1} << levels;
    double before = 0;
    for (Index f = 0; f < frames; f += stride) {
      const double step = coded_.steps.step(place_, f);
      if (!round(f, (values_[f] - before) / step, 0)) return false;
      before += coded_.knots(f, column_) * step;
    }
    for (int level = levels - 1; level >= 0; --level) {
      const Index apart = Index{1} << level;
      for (Index f = apart; f < frames; f += 2 * apart) {
        const double value = values_[f] / coded_.steps.step(place_, f);
        const double zone = std::abs(value) >= 1
                                ? large_dead_zone
                                : dead_zone + quiet_zone * std::exp(-around(f, apart));
        if (!round(f, value, zone)) return false;
      }
    }
    return true;
  }

 private:
  bool round(Index f, double value, double zone) {
    const double magnitude = std::floor(std::abs(value) + 0.5 - zone);
    if (!(magnitude < most_knot)) return false;
    coded_.knots(f, column_) = static_cast<std::int32_t>(value < 0 ? -magnitude : magnitude);
    return true;
  }

  double size(Index f, Index column) const {
    if (f < 0 || f >= coded_.shape.frames || column < 0) return 0;
    return std::abs(coded_.knots(f, column));
  }

  /// How large a knot may be, by those that a decoder has before it: of the channel, of the channel
  /// before it and of the one above.
  double around(Index f, Index apart) const {
    const Index step = 2 * apart;
    const auto beside = [&](Index column) {
      return 2 * size(f, column) + size(f - step, column) + size(f + step, column);
    };
    return (4 * size(f - step, column_) + 2 * size(f - 2 * step, column_) +
            size(f - apart, column_) + size(f + apart, column_) + beside(column_ - 1) +
            beside(above_)) /
           16;
  }

  const Eigen::VectorXd& values_;
  std::size_t place_;
  Index column_, above_;
  CodedChannels& coded_;
};

}  // namespace

bool round_knots(const Eigen::VectorXd& values, std::size_t place, CodedChannels& coded) {
  return KnotRounder(values, place, coded).run();
}

}  // namespace reprise
