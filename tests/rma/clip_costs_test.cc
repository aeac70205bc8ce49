// Equations 2 and 3 on numbers that can be worked out by hand.
#include "rma/clip_costs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace reprise {
namespace {

TEST(ClipCosts, AreDeviationsTimesLength) {
  // One coordinate: 7 0 3 0 5; clip [1, 4) has its median sample at 2, distances 3, 0, 3. The
  // take's first posture is 4 from the median.
  PostureMatrix take(5, 1);
  take << 7, 0, 3, 0, 5;
  const double deviation = std::sqrt(2.0);
  EXPECT_NEAR(primary_cost(take, 1, 4), 3 * deviation + 4, 1e-6);
  PostureMatrix other(3, 1);
  other << 1, 1, 1;
  const std::vector<long> reference = {0, 1, 2};
  // Distances 1, 2, 1.
  EXPECT_NEAR(repeated_cost(take, 1, 4, other, reference), 3 * std::sqrt(2.0 / 9), 1e-6);
}

}  // namespace
}  // namespace reprise
