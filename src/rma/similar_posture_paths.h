// Similar-posture paths of a self-distance plot (lin-2011 section 4.2.1).
#pragma once

#include <vector>

#include "rma/postures.h"
#include "rma/repeat_constants.h"

namespace reprise {

/// A pixel of the plot: sample `x` of one take beside sample `y` of another (or the same).
struct PlotPixel {
  long x = 0;
  long y = 0;
};

/// Pixels with x and y rising, from one end to the other, no step steeper than
/// RepeatConstants::steepest; and their mean distance.
struct SimilarPath {
  std::vector<PlotPixel> pixels;
  float mean_mm = 0;

  /// In samples.
  long manhattan_length() const;
};

/// The path of least cost through `start` towards both ends: it goes on as long as what is similar
/// outweighs what is not, over a bridge of dissimilar pixels too. The plot is not computed but
/// where the path may lie. `x` and `y` are projected postures; with `same_take` the pixels near the
/// diagonal are forbidden. Without pixels where `start` itself is forbidden.
SimilarPath trace_path(const PostureMatrix& x, const PostureMatrix& y, PlotPixel start,
                       bool same_take, const RepeatConstants& constants);

}  // namespace reprise
