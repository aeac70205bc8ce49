// The self-distance plot of a take.
#include "rma/self_distance_plot.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "rma/made_up_postures.h"

namespace reprise {
namespace {

const RepeatConstants constants;

TEST(SelfDistancePlot, HoldsTheDistancesOfPostures) {
  const PostureMatrix take = made_up_take(1, 0, 4);
  const PostureMatrix distances = self_distances(take);
  ASSERT_EQ(distances.rows(), take.rows());
  ASSERT_EQ(distances.cols(), take.rows());
  for (long x = 0; x < take.rows(); x += 7) {
    for (long y = 0; y < take.rows(); y += 5) {
      EXPECT_NEAR(distances(x, y), (take.row(x) - take.row(y)).norm(), 0.5);
    }
  }
}

TEST(SelfDistancePlot, MinimaLieOnWhatRepeats) {
  // The same 3 s again after 5 s.
  const PostureLibrary library(
      {joined({made_up_take(1, 0, 3), made_up_take(2, 0, 2), made_up_take(1, 0, 3)})}, constants);
  const auto minima = plot_minima(self_distances(library.projected[0]), 0, constants);
  ASSERT_FALSE(minima.empty());
  EXPECT_EQ(minima[0].other_sample - minima[0].sample, 75);
  const long least_lag = std::lround(constants.least_lag_s * constants.rate);
  for (const NearPair& pair : minima) EXPECT_GE(pair.other_sample - pair.sample, least_lag);
}

TEST(SelfDistancePlot, OfNothingIsEmpty) {
  EXPECT_TRUE(plot_minima(self_distances(PostureMatrix(0, 3)), 0, constants).empty());
}

}  // namespace
}  // namespace reprise
