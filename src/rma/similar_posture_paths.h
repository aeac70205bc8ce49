// Similar-posture paths of a self-distance plot (lin-2011 section 4.2.1).
#pragma once

#include <memory>
#include <span>
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

/// One side of a plot: projected postures, and of each the distance (mm, above 0) from which on a
/// posture is dissimilar. Two postures are dissimilar from the geometric mean of theirs on.
struct PlotSide {
  const PostureMatrix& postures;
  std::span<const float> similar_mm;
};

/// Traces one path after another in the same memory; one thread at a time.
class PathTracer {
 public:
  explicit PathTracer(const RepeatConstants& constants);
  ~PathTracer();

  /// The path of least cost through `start` towards both ends: it goes on as long as what is
  /// similar outweighs what is not, over a bridge of dissimilar pixels too. The plot is not
  /// computed but where the path may lie. With `same_take` the pixels near the diagonal are
  /// forbidden. Without pixels where `start` itself is forbidden.
  SimilarPath trace(const PlotSide& x, const PlotSide& y, PlotPixel start, bool same_take);

 private:
  class Explorer;
  long least_lag_;
  std::unique_ptr<Explorer> explorer_;
};

}  // namespace reprise
