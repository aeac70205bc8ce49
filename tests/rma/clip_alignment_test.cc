// Where a take does what a clip does.
#include "rma/clip_alignment.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "rma/made_up_postures.h"
#include "rma/repeat_groups.h"

namespace reprise {
namespace {

class ClipAlignment : public testing::TestWithParam<double> {};

TEST_P(ClipAlignment, FindsTheClipAtItsSpeed) {
  const double speed = GetParam(), seconds = 2 / speed;
  const PostureLibrary library(
      {made_up_take(1, 0, 2),
       joined({made_up_take(2, 0, 3), made_up_take(1, 0, seconds, speed), made_up_take(3, 0, 3)})},
      {});
  const long end = library.postures[1].rows();
  const auto found = align_clip(library.view(0, 0, 30), library.view(1, 0, end), 60);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(static_cast<double>(found[0].begin), 45, 2);
  EXPECT_NEAR(static_cast<double>(found[0].end), 45 + seconds * 15, 3);
  ASSERT_EQ(found[0].map.size(), 30u);
  EXPECT_TRUE(std::ranges::is_sorted(found[0].map));
}

INSTANTIATE_TEST_SUITE_P(Speeds, ClipAlignment, testing::Values(0.5, 0.75, 1.0, 1.33, 2.0));

TEST(ClipAlignmentOf, OthersFindsNothing) {
  const PostureLibrary library({made_up_take(1, 0, 2), made_up_take(2, 0, 6)}, {});
  EXPECT_TRUE(align_clip(library.view(0, 0, 30), library.view(1, 0, 90), 30).empty());
}

TEST(ClipAlignmentOf, ALongClipIsHeldAgainstAllOfIt) {
  const PostureLibrary library(
      {made_up_take(1, 0, 40), joined({made_up_take(2, 0, 7), made_up_take(1, 0, 40)})}, {});
  const auto found = align_clip(library.view(0, 0, 600), library.view(1, 0, 705), 60);
  ASSERT_EQ(found.size(), 1u);
  for (long s = 0; s < 600; ++s) ASSERT_EQ(found[0].map[static_cast<std::size_t>(s)], 105 + s);
  EXPECT_EQ(found[0].mean_mm, 0);
}

TEST(ClipAlignmentOf, TwoOccurrencesDoNotOverlap) {
  const PostureLibrary library(
      {made_up_take(1, 0, 2), joined({made_up_take(1, 0, 2), made_up_take(1, 0, 2)})}, {});
  const auto found = align_clip(library.view(0, 0, 30), library.view(1, 0, 60), 60);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(found[0].end <= found[1].begin || found[1].end <= found[0].begin);
  EXPECT_LT(found[0].mean_mm, 1);
}

TEST(ClipAlignmentOf, AClipOfOneSampleIsNoMotion) {
  const PostureLibrary library({made_up_take(1, 0, 2)}, {});
  EXPECT_TRUE(align_clip(library.view(0, 0, 1), library.view(0, 0, 30), 60).empty());
}

}  // namespace
}  // namespace reprise
