// Paths of a self-distance plot.
#include "rma/similar_posture_paths.h"

#include <gtest/gtest.h>

#include "rma/made_up_postures.h"
#include "rma/repeat_groups.h"

namespace reprise {
namespace {

const RepeatConstants constants;

TEST(SimilarPostureTrace, EndsWhereTheMotionsPart) {
  const PostureLibrary library(
      {joined({made_up_take(2, 0, 3), made_up_take(1, 0, 2), made_up_take(3, 0, 3)}),
       joined({made_up_take(4, 0, 2), made_up_take(1, 0, 4, 0.5), made_up_take(5, 0, 2)})},
      constants);
  const SimilarPath path =
      PathTracer(constants).trace(library.side(0, 1), library.side(1, 0), {60, 60}, false);
  ASSERT_FALSE(path.pixels.empty());
  EXPECT_NEAR(static_cast<double>(path.pixels.front().x), 45, 3);
  EXPECT_NEAR(static_cast<double>(path.pixels.back().x), 74, 3);
  EXPECT_NEAR(static_cast<double>(path.pixels.front().y), 30, 5);
  EXPECT_NEAR(static_cast<double>(path.pixels.back().y), 89, 5);
  EXPECT_EQ(path.manhattan_length(), path.pixels.back().x - path.pixels.front().x +
                                         path.pixels.back().y - path.pixels.front().y);
}

TEST(SimilarPostureTrace, RisesInBothByStepsThatAreNotTooSteep) {
  const PostureLibrary library({made_up_take(1, 0, 4), made_up_take(1, 0, 6, 0.7)}, constants);
  const SimilarPath path =
      PathTracer(constants).trace(library.side(0, 1), library.side(1, 0), {30, 43}, false);
  ASSERT_GT(path.pixels.size(), 10u);
  for (std::size_t i = 1; i < path.pixels.size(); ++i) {
    const long x = path.pixels[i].x - path.pixels[i - 1].x;
    const long y = path.pixels[i].y - path.pixels[i - 1].y;
    EXPECT_GE(std::min(x, y), 1);
    EXPECT_LE(std::max(x, y), RepeatConstants::steepest);
  }
}

TEST(SimilarPostureTrace, CrossesAShortBridgeOnly) {
  const auto with_gap = [](double seconds) {
    return joined(
        {made_up_take(1, 0, 2), made_up_take(7, 0, seconds), made_up_take(1, 2 + seconds, 2)});
  };
  const auto end_with_gap = [&](double seconds) {
    const PostureLibrary library({made_up_take(1, 0, 4 + seconds), with_gap(seconds)}, constants);
    return PathTracer(constants)
        .trace(library.side(0, 1), library.side(1, 0), {10, 10}, false)
        .pixels.back()
        .x;
  };
  EXPECT_GT(end_with_gap(0.07), 50);
  EXPECT_LT(end_with_gap(1.5), 35);
}

TEST(SimilarPostureTrace, KeepsAwayFromTheDiagonal) {
  const PostureLibrary library({made_up_take(1, 0, 4)}, constants);
  const SimilarPath path =
      PathTracer(constants).trace(library.side(0, 0), library.side(0, 0), {10, 20}, true);
  for (const PlotPixel& pixel : path.pixels) EXPECT_GE(pixel.y - pixel.x, 6);
  EXPECT_TRUE(PathTracer(constants)
                  .trace(library.side(0, 0), library.side(0, 0), {10, 12}, true)
                  .pixels.empty());
}

}  // namespace
}  // namespace reprise
