#include "query/distance_tally.h"

#include <gtest/gtest.h>

#include <random>

namespace reprise {
namespace {

TEST(DistanceTally, SaysWhatSortingAllDistancesWould) {
  std::mt19937 random(1);
  for (const double scale : {1e-6, 3.0, 4000.0}) {
    std::lognormal_distribution<float> distribution(0, 1.5);
    std::vector<float> all;
    DistanceTally tally;
    for (int take = 0; take < 20; ++take) {
      std::vector<float> distances(1 + random() % 500);
      for (float& distance : distances) {
        distance = static_cast<float>(scale) * distribution(random);
      }
      tally.add(distances);
      all.insert(all.end(), distances.begin(), distances.end());
    }
    const PositionErrors sorted = summarise_distances(all), told = tally.errors();
    EXPECT_NEAR(told.mean, sorted.mean, 1e-9 * sorted.mean);
    EXPECT_NEAR(told.rms, sorted.rms, 1e-9 * sorted.rms);
    // Between two distances sorting interpolates, where the tail is thin they are far apart.
    EXPECT_NEAR(told.p99, sorted.p99, 0.01 * sorted.p99);
    EXPECT_EQ(told.max, sorted.max);
  }
}

TEST(DistanceTally, NothingIsNoError) {
  EXPECT_EQ(DistanceTally().errors().max, 0);
  DistanceTally zeros;
  zeros.add(std::vector<float>(10));
  EXPECT_EQ(zeros.errors().p99, 0);
}

}  // namespace
}  // namespace reprise
