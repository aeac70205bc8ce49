#include "quant/knot_order.h"

#include <algorithm>
#include <cmath>

namespace reprise {
namespace {

using Eigen::Index;

void add_levels(const KnotShape& shape, const ColumnRun& run, std::vector<KnotGroup>& order) {
  for (int level = shape.levels; level >= 0; --level) {
    const bool coarsest = level == shape.levels;
    const Index stride = Index{1} << level;
    const Index step = coarsest ? stride : 2 * stride;
    const int slot = coarsest ? KnotSlots::levels - 1
                              : std::min(KnotSlots::levels - 2, level + shape.first_level);
    KnotGroup group{slot, run.first, run.last, coarsest, {}};
    for (Index f = coarsest ? 0 : stride; f < shape.frames; f += step) {
      const auto inside = [&](Index row) { return row >= 0 && row < shape.frames ? row : -1; };
      KnotRow row{f, inside(f - step), inside(f - 2 * step), -1, -1};
      if (!coarsest) {
        row.left = inside(f - stride);
        row.right = inside(f + stride);
      }
      group.rows.push_back(row);
    }
    order.push_back(std::move(group));
  }
}

/// The band of a frequency, in basic operations alone: the borders are 0.1 Hz times 2^((i -
/// 1/2)/2).
int band_of(const KnotShape& shape, Index row) {
  if (row == 0) return 0;
  constexpr double root_of_two = 1.4142135623730951;
  const double tenths = 10.0 * static_cast<double>(row) * shape.frame_rate /
                        (2.0 * static_cast<double>(shape.frames));
  const double square = tenths * tenths * root_of_two;
  int band = 1;
  for (double border = 2; band < KnotSlots::bands - 1 && square >= border; border *= 2) ++band;
  return band;
}

void add_bands(const KnotShape& shape, const ColumnRun& run, std::vector<KnotGroup>& order) {
  int open = -1;
  for (Index row = 0; row < shape.frames; ++row) {
    const int band = band_of(shape, row);
    if (band != open) order.push_back({KnotSlots::levels + band, run.first, run.last, false, {}});
    open = band;
    const auto inside = [](Index r) { return std::max<Index>(r, -1); };
    order.back().rows.push_back(
        {row, inside(row - 1), inside(row - 2), inside(row - 3), inside(row - 4)});
  }
}

}  // namespace

int first_level_of(double frame_rate) {
  return std::clamp(static_cast<int>(std::lround(std::log2(120.0 / frame_rate))), 0, 6);
}

std::vector<ColumnRun> column_runs(const KnotShape& shape) {
  if (shape.kind == shape.root_kind) return {{shape.kind, 0, shape.trajectories}};
  const int last = shape.trajectories - shape.direct;
  std::vector<ColumnRun> runs;
  for (const ColumnRun& run :
       {ColumnRun{shape.root_kind, 0, shape.root}, ColumnRun{shape.kind, shape.root, last},
        ColumnRun{shape.root_kind, last, shape.trajectories}}) {
    if (run.first < run.last) runs.push_back(run);
  }
  return runs;
}

std::vector<KnotGroup> knot_order(const KnotShape& shape) {
  std::vector<KnotGroup> order;
  for (const ColumnRun& run : column_runs(shape)) {
    run.kind == CurveKind::cosines ? add_bands(shape, run, order) : add_levels(shape, run, order);
  }
  return order;
}

}  // namespace reprise
