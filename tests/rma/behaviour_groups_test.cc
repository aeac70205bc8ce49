// Which segments are one behaviour.
#include "rma/behaviour_groups.h"

#include <gtest/gtest.h>

#include <set>

#include "rma/made_up_behaviours.h"

namespace reprise {
namespace {

/// `behaviours` behaviours, each in as many segments of different lengths.
std::vector<SegmentShape> shapes_of(int behaviours, int segments) {
  std::vector<SegmentShape> shapes;
  for (int i = 0; i < segments; ++i) {
    for (int b = 0; b < behaviours; ++b) {
      shapes.push_back(segment_shape(swinging(b + 1, 3.0 + i % 3)));
    }
  }
  return shapes;
}

void expect_groups(const std::vector<int>& groups, int behaviours) {
  EXPECT_EQ(std::set<int>(groups.begin(), groups.end()).size(),
            static_cast<std::size_t>(behaviours));
  for (std::size_t s = 0; s < groups.size(); ++s) {
    EXPECT_EQ(groups[s], static_cast<int>(s) % behaviours) << s;
  }
}

TEST(BehaviourGroups, HoldWhatIsAlike) { expect_groups(group_segments(shapes_of(5, 4)), 5); }

TEST(BehaviourGroups, MoreSegmentsThanAreSampledJoinThem) {
  GroupConstants constants;
  constants.most_sampled = 25;
  expect_groups(group_segments(shapes_of(5, 20), constants), 5);
}

TEST(BehaviourGroups, WhatComesLaterJoinsWhatFits) {
  const std::vector<SegmentShape> shapes = shapes_of(5, 4);
  std::vector<KnownSegment> known;
  // Behaviours 0 and 2 are known, as groups 17 and 4.
  for (std::size_t s = 0; s < shapes.size() / 2; ++s) {
    if (s % 5 == 0) known.push_back({shapes[s], 17});
    if (s % 5 == 2) known.push_back({shapes[s], 4});
  }
  const std::vector<std::int64_t> groups = join_groups(shapes, known, 30);
  const std::vector<std::int64_t> expected = {17, 30, 4, 31, 32};
  for (std::size_t s = 0; s < groups.size(); ++s) EXPECT_EQ(groups[s], expected[s % 5]) << s;
  EXPECT_TRUE(join_groups({}, known, 30).empty());
}

TEST(BehaviourGroups, OneSegmentIsOneGroup) {
  EXPECT_EQ(group_segments(shapes_of(1, 1)), std::vector<int>{0});
  EXPECT_TRUE(group_segments({}).empty());
}

TEST(BehaviourGroups, EqualSegmentsAreOneGroup) {
  const std::vector<SegmentShape> equal(7, segment_shape(swinging(1, 3)));
  EXPECT_EQ(group_segments(equal), std::vector<int>(7, 0));
}

TEST(BehaviourGroups, TwinsAndOneThatRoundingKeepsFromItself) {
  // Most have a twin exactly as they are; the axes of one are short of 1 by what rounding does.
  std::vector<SegmentShape> shapes;
  for (const int behaviour : {0, 0, 1, 1, 2}) {
    SegmentShape shape;
    shape.axes = Eigen::MatrixXd::Identity(9, 9).middleCols(3 * behaviour, 3);
    shape.mean_posture = Eigen::VectorXd::Unit(9, behaviour);
    shapes.push_back(shape);
  }
  shapes.back().axes *= 1 - 1e-15;
  EXPECT_EQ(group_segments(shapes), (std::vector<int>{0, 0, 1, 1, 2}));
}

TEST(SegmentDistance, AnAxisAndItsOppositeAreTheSame) {
  const SegmentShape shape = segment_shape(swinging(1, 4));
  SegmentShape turned = shape;
  turned.axes = -turned.axes;
  EXPECT_NEAR(segment_distance(shape, turned), 0, 1e-6);
}

TEST(SegmentDistance, IsSymmetricAndLeastToItself) {
  const SegmentShape a = segment_shape(swinging(1, 4)), b = segment_shape(swinging(2, 4));
  EXPECT_DOUBLE_EQ(segment_distance(a, b), segment_distance(b, a));
  EXPECT_GT(segment_distance(a, b), 0.1);
  EXPECT_NEAR(segment_distance(a, a), 0, 1e-6);
}

TEST(SegmentDistance, OfFewSamplesIsANumber) {
  const SegmentShape one = segment_shape(swinging(1, 4).topRows(1));
  EXPECT_TRUE(std::isfinite(segment_distance(one, one)));
  EXPECT_TRUE(std::isfinite(segment_distance(one, segment_shape(PostureMatrix::Zero(5, 12)))));
}

}  // namespace
}  // namespace reprise
