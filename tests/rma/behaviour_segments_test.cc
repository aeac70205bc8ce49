// Where one behaviour ends and the next begins.
#include "rma/behaviour_segments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "rma/made_up_behaviours.h"

namespace reprise {
namespace {

constexpr double rate = 15;

TEST(BehaviourSegments, BeginWhereTheMotionChanges) {
  const PostureMatrix take = joined({swinging(1, 8), swinging(2, 8), swinging(3, 8)});
  const std::vector<long> cuts = behaviour_cuts(take, rate);
  for (const long change : {120L, 240L}) {
    EXPECT_TRUE(std::ranges::any_of(cuts, [&](long cut) { return std::labs(cut - change) <= 8; }))
        << change;
  }
}

TEST(BehaviourSegments, OneBehaviourIsNotCut) {
  EXPECT_TRUE(behaviour_cuts(swinging(1, 20), rate).empty());
}

TEST(BehaviourSegments, CutsRiseAndLieInside) {
  PostureMatrix take = swinging(1, 5);
  for (int seed = 2; seed < 12; ++seed) take = joined({take, swinging(seed, 2.0 + seed % 4)});
  const std::vector<long> cuts = behaviour_cuts(take, rate);
  ASSERT_GE(cuts.size(), 3u);
  const long apart = std::lround(SegmentConstants().same_cut_s * rate);
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    EXPECT_GT(cuts[i], 0);
    EXPECT_LT(cuts[i], take.rows());
    if (i > 0) EXPECT_GE(cuts[i] - cuts[i - 1], apart);
  }
}

TEST(BehaviourSegments, AreAboutTheSameInATakeThatIsSampledTwiceAsOften) {
  const PostureMatrix slow = joined({swinging(1, 8), swinging(2, 8)});
  const PostureMatrix fast = joined({swinging(1, 8, 30), swinging(2, 8, 30)});
  const std::vector<long> cuts = behaviour_cuts(slow, rate), finer = behaviour_cuts(fast, 30);
  ASSERT_FALSE(cuts.empty());
  for (const long cut : cuts) {
    EXPECT_TRUE(std::ranges::any_of(finer, [&](long f) { return std::labs(f - 2 * cut) <= 15; }));
  }
}

TEST(BehaviourSegments, ATakeThatIsTooShortIsOne) {
  const PostureMatrix take = joined({swinging(1, 1.4), swinging(2, 1.4)});
  EXPECT_TRUE(behaviour_cuts(take, rate).empty());
  EXPECT_TRUE(behaviour_cuts(PostureMatrix(0, 12), rate).empty());
}

TEST(BehaviourSegments, DoNotDependOnWhereThePosturesLie) {
  const PostureMatrix take = joined({swinging(1, 30), swinging(2, 8), swinging(3, 30)});
  PostureMatrix far = take;
  far.array() += 4096;
  const std::vector<long> cuts = behaviour_cuts(take, rate);
  EXPECT_FALSE(cuts.empty());
  EXPECT_EQ(behaviour_cuts(far, rate), cuts);
}

TEST(BehaviourSegments, AStillTakeIsOne) {
  EXPECT_TRUE(behaviour_cuts(PostureMatrix::Constant(200, 12, 5), rate).empty());
}

}  // namespace
}  // namespace reprise
