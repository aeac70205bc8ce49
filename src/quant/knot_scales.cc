// How large knots are in a library: measured, rounded, and looked up.
#include <algorithm>
#include <cmath>

#include "quant/trajectory_codec.h"

namespace reprise {

int KnotScales::column_of(const KnotShape& shape, int column) const {
  // Columns of a take that does not tumble; the further columns of one that does are taken for its
  // heading's.
  constexpr int upright_root = 4;
  if (column < shape.root) return std::min(column, upright_root - 1);
  return column - shape.root + std::min(shape.root, upright_root);
}

void KnotScales::add(const KnotShape& shape, const Eigen::MatrixXd& knots) {
  if (shape.root > 4) return;
  if (squares_.empty()) {
    columns = shape.trajectories;
    squares_.assign(static_cast<std::size_t>(KnotSlots::count * columns), 0);
    counts_ = squares_;
  }
  for (const KnotGroup& group : knot_order(shape)) {
    for (const KnotRow& row : group.rows) {
      for (int c = group.first_column; c < std::min(group.last_column, columns); ++c) {
        // The coarsest knots of the root are coded by what they differ from the one before.
        const bool follows = group.coarsest && (c < shape.root || c >= columns - shape.direct);
        if (follows && row.before < 0) continue;
        const double value = knots(row.row, c) - (follows ? knots(row.before, c) : 0.0);
        const auto i = static_cast<std::size_t>(group.slot * columns + c);
        squares_[i] += value * value;
        counts_[i] += 1;
      }
    }
  }
}

void KnotScales::settle() {
  codes.clear();
  for (std::size_t i = 0; i < squares_.size(); ++i) {
    const double mean = counts_[i] > 0 ? squares_[i] / counts_[i] : 0;
    const double half_octaves = std::log2(std::max(mean, 1e-12));  // 2 log2 of the root
    codes.push_back(static_cast<std::int8_t>(
        std::clamp(static_cast<int>(std::lround(half_octaves)), least, most)));
  }
  kinds.fill(true);
}

void KnotScales::keep(const std::array<bool, curve_kinds>& kept) {
  kinds = kept;
  for (int kind = 0; kind < curve_kinds; ++kind) {
    if (kept[kind]) continue;
    const auto of = static_cast<CurveKind>(kind);
    std::fill_n(codes.begin() + KnotSlots::first_of(of) * columns,
                KnotSlots::count_of(of) * columns, static_cast<std::int8_t>(least));
  }
}

int KnotScales::at(const KnotShape& shape, int slot, int column) const {
  const int own = column_of(shape, column);
  return own < columns ? codes[static_cast<std::size_t>(slot * columns + own)] : least;
}

}  // namespace reprise
