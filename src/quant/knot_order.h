// In which order the numbers of a take's curves are coded, and which of them are near each other.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace reprise {

/// How a curve over time is written as numbers.
enum class CurveKind {
  nested_knots = 0,  ///< NestedKnots: rows are frames, coarse knots first
  cosines = 1,       ///< cosine_transform: rows are frequencies
};
constexpr int curve_kinds = 2;

/// What the decoder must know before the numbers.
struct KnotShape {
  long frames = 0;
  int trajectories = 0;
  int root = 0;    ///< how many of them, the first ones, are the root's track
  int direct = 0;  ///< how many of them, the last ones, are direct channels
  int levels = 0;
  /// The finest level counted in frames of 120 Hz, so that takes of all rates share what was
  /// learned of a level: 0 at 120 Hz, 1 at 60 Hz, 2 at 30 Hz.
  int first_level = 0;
  int step_half_octaves = 0;  ///< logarithm of the quantiser's step (mm)
  double frame_rate = 120;
  CurveKind kind = CurveKind::nested_knots;       ///< of the axes' coefficients
  CurveKind root_kind = CurveKind::nested_knots;  ///< of the root and the direct channels
};
int first_level_of(double frame_rate);

/// A row of numbers and those that are near it; -1 where there is none.
struct KnotRow {
  Eigen::Index row = 0;
  Eigen::Index before = -1, before_that = -1;  ///< of the same level or band
  Eigen::Index left = -1, right = -1;          ///< of coarser levels or lower bands
};

/// Rows of one level or band, for some of the trajectories.
struct KnotGroup {
  int slot = 0;                           ///< KnotSlots
  int first_column = 0, last_column = 0;  ///< [first, last)
  bool coarsest = false;  ///< knots of the root and direct channels are coded as differences
  std::vector<KnotRow> rows;
};

/// What contexts and scales know of a level or band: 14 levels of nested knots, counted from 120
/// Hz, the last one the coarsest; then the mean; then 15 bands of half an octave around 0.1 Hz,
/// 0.14 Hz and so on.
struct KnotSlots {
  static constexpr int levels = 14;
  static constexpr int bands = 16;
  static constexpr int count = levels + bands;
  static constexpr int first_of(CurveKind kind) { return kind == CurveKind::cosines ? levels : 0; }
  static constexpr int count_of(CurveKind kind) {
    return kind == CurveKind::cosines ? bands : levels;
  }
};

/// All rows of all trajectories, each once.
std::vector<KnotGroup> knot_order(const KnotShape& shape);

/// Runs of columns that are written the same way: a kind and [first, last).
struct ColumnRun {
  CurveKind kind;
  int first, last;
};
std::vector<ColumnRun> column_runs(const KnotShape& shape);

}  // namespace reprise
