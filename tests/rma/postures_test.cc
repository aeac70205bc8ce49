// Aligned postures: what they forget and what they keep.
#include "rma/postures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "reprise/formats/motion_file.h"
#include "rma/made_up_postures.h"

namespace reprise {
namespace {

constexpr const char* two_bones =
    "HIERARCHY\nROOT Hips\n{\n OFFSET 0 0 0\n CHANNELS 6 Xposition Yposition Zposition Yrotation "
    "Xrotation Zrotation\n JOINT Arm\n {\n  OFFSET 10 20 0\n  CHANNELS 3 Zrotation Xrotation "
    "Yrotation\n  End Site\n  {\n   OFFSET 0 30 0\n  }\n }\n}\nMOTION\nFrames: 4\nFrame Time: "
    "0.1\n";

Take take_with(const std::string& rows) { return read_bvh(std::string(two_bones) + rows, "a.bvh"); }

TEST(AlignedPostures, ForgetPlaceAndHeading) {
  const Take here = take_with(
      "0 90 0 0 0 0 10 20 30\n0 91 0 5 0 0 12 20 30\n0 92 0 10 0 0 14 20 30\n0 93 0 15 0 0 16 20 "
      "30\n");
  const Take there = take_with(
      "70 90 -9 100 0 0 10 20 30\n71 91 0 105 0 0 12 20 30\n72 92 3 110 0 0 14 20 30\n73 93 4 -245 "
      "0 0 "
      "16 20 30\n");
  const PostureMatrix a = aligned_postures(here, {0, 1}, 10);
  const PostureMatrix b = aligned_postures(there, {0, 1}, 10);
  ASSERT_EQ(a.rows(), 4);
  ASSERT_EQ(a.cols(), 9);
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 0.01);
}

TEST(AlignedPostures, KeepHeight) {
  const Take low =
      take_with("0 50 0 0 0 0 0 0 0\n0 50 0 0 0 0 0 0 0\n0 50 0 0 0 0 0 0 0\n0 50 0 0 0 0 0 0 0\n");
  const Take high =
      take_with("0 90 0 0 0 0 0 0 0\n0 90 0 0 0 0 0 0 0\n0 90 0 0 0 0 0 0 0\n0 90 0 0 0 0 0 0 0\n");
  const PostureMatrix a = aligned_postures(low, {0, 1}, 10);
  const PostureMatrix b = aligned_postures(high, {0, 1}, 10);
  EXPECT_NEAR(mean_joint_distance(a.row(0).data(), b.row(0).data(), a.cols()), 400, 0.01);
}

TEST(AlignedPostures, OtherRatesLieBetweenFrames) {
  const Take take =
      take_with("0 90 0 0 0 0 0 0 0\n0 92 0 0 0 0 0 0 0\n0 94 0 0 0 0 0 0 0\n0 96 0 0 0 0 0 0 0\n");
  const PostureMatrix fine = aligned_postures(take, {0, 1}, 20);
  ASSERT_EQ(fine.rows(), 7);
  EXPECT_NEAR(fine(1, 1), 910, 0.01);
  EXPECT_EQ(aligned_postures(take, {0, 1}, 5).rows(), 2);
}

TEST(BodySize, IsTheLengthOfAllBonesUnderTheRoot) {
  const Take take =
      take_with("5 90 7 0 0 0 10 20 30\n0 0 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 0 0\n");
  EXPECT_NEAR(body_size(take, {0, 1}), 10 * (std::hypot(10, 20) + 30), 0.01);
  EXPECT_NEAR(body_size(take, {1, 1}), 300, 0.01);
}

TEST(BodySize, FactorsBringAllToTheMedian) {
  const std::vector<double> sizes{500, 1000, 2000};
  EXPECT_EQ(factors_to_median_size(sizes), (std::vector<float>{2, 1, 0.5F}));
  const std::vector<double> one_unknown{0, 1000, 1000};
  EXPECT_EQ(factors_to_median_size(one_unknown), (std::vector<float>{1, 1, 1}));
  EXPECT_TRUE(factors_to_median_size({}).empty());
}

TEST(PostureBasis, ProjectedDistancesAreNeverLarger) {
  const std::vector<PostureMatrix> takes{made_up_take(1, 0, 5), made_up_take(2, 0, 5)};
  const PostureBasis few(takes, 3), all(takes, 12);
  const PostureMatrix p = few.project(takes[0]), q = all.project(takes[0]);
  EXPECT_EQ(p.cols(), 3);
  for (long s = 1; s < p.rows(); ++s) {
    const double full = (takes[0].row(s) - takes[0].row(0)).norm() / std::sqrt(4.0);
    EXPECT_LE((p.row(s) - p.row(0)).norm(), full * 1.001);
    EXPECT_NEAR((q.row(s) - q.row(0)).norm(), full, 0.1);
  }
}

TEST(PostureBasis, NothingGivesNothing) {
  const std::vector<PostureMatrix> takes{PostureMatrix(0, 9)};
  EXPECT_EQ(PostureBasis(takes, 4).project(takes[0]).rows(), 0);
}

}  // namespace
}  // namespace reprise
