#include "contacts/contact_detection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "contacts/legged_skeletons.h"
#include "edited_motion.h"

namespace reprise {
namespace {

using namespace testing_contacts;

int joint_named(const Skeleton& skeleton, const std::string& name) {
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (skeleton.joints[j].name == name) return static_cast<int>(j);
  }
  return -1;
}

/// All joints 1 m up and moving at 1 m/s, but that left_toes stand on the floor from `first` to
/// before `end`.
PositionMatrix flight(const Skeleton& skeleton, long frames, double rate, long first, long end) {
  PositionMatrix positions(frames, 3 * static_cast<Eigen::Index>(skeleton.joints.size()));
  for (Eigen::Index f = 0; f < frames; ++f) {
    for (Eigen::Index j = 0; 3 * j < positions.cols(); ++j) {
      positions(f, 3 * j) = 1000 * static_cast<double>(f) / rate;
      positions(f, 3 * j + 1) = 1000;
      positions(f, 3 * j + 2) = 0;
    }
  }
  const Eigen::Index toes = joint_named(skeleton, "left_toes");
  for (Eigen::Index f = first; f < end; ++f) {
    positions(f, 3 * toes) = 500;
    positions(f, 3 * toes + 1) = 0;
  }
  return positions;
}

TEST(Legs, ReachFromTheHipToTheToes) {
  const auto skeleton = legs_of_bvh();
  const std::vector<Leg> legs = find_legs(*skeleton);
  ASSERT_EQ(legs.size(), 2u);
  EXPECT_EQ(legs[0].points, (std::vector<std::vector<int>>{{joint_named(*skeleton, "left_ankle")},
                                                           {joint_named(*skeleton, "left_toes")}}));
  EXPECT_EQ(legs[0].joints, (std::vector<int>{joint_named(*skeleton, "left_hip"),
                                              joint_named(*skeleton, "left_knee"),
                                              joint_named(*skeleton, "left_ankle")}));
  EXPECT_EQ(count_points(legs), 4);
}

TEST(Legs, OfBonesEndWithTheFootItself) {
  const auto skeleton = skeletons::asf();
  const std::vector<Leg> legs = find_legs(*skeleton);
  ASSERT_EQ(legs.size(), 1u);
  EXPECT_EQ(legs[0].joints.back(), joint_named(*skeleton, "foot"));
}

TEST(Legs, WithoutNamesAreThoseWithTheLowestEnds) {
  const auto skeleton = legs_of_bvh("_a", "_t");
  const std::vector<Leg> legs = find_legs(*skeleton);
  ASSERT_EQ(legs.size(), 2u);
  for (const Leg& leg : legs) {
    ASSERT_EQ(leg.points.size(), 1u);
    EXPECT_TRUE(skeleton->joints[static_cast<std::size_t>(leg.points[0][0])].end_site);
  }
}

TEST(Legs, AreNotFoundWhereNothingHangsDown) {
  EXPECT_TRUE(find_legs(*skeletons::chain()).empty());
}

TEST(ContactDetection, HeightsAreAlongTheAxisThatPointsUp) {
  const auto skeleton = legs_of_bvh();
  const std::vector<Leg> legs = find_legs(*skeleton);
  const PositionMatrix standing = flight(*skeleton, 240, 60, 60, 120);
  const auto expected = find_contacts(legs, standing, 60, UpAxis::y);
  ASSERT_FALSE(expected.empty());
  for (const UpAxis up : edited::every_up) {
    PositionMatrix turned = standing;
    for (Eigen::Index j = 0; 3 * j < turned.cols(); ++j) {
      turned.middleCols<3>(3 * j) = (standing.middleCols<3>(3 * j) * turn_to_y(up)).eval();
    }
    EXPECT_EQ(find_contacts(legs, turned, 60, up), expected) << up_axis_name(up);
  }
}

TEST(Legs, WithoutNamesHangDownWhicheverAxisPointsUp) {
  Take rest;
  rest.skeleton = legs_of_bvh("_a", "_t");
  rest.channels = ChannelMatrix::Zero(1, rest.skeleton->channel_count);
  for (const UpAxis up : edited::every_up) {
    Skeleton skeleton = *edited::turned(rest, up).skeleton;
    skeleton.up = up;
    EXPECT_EQ(find_legs(skeleton).size(), 2u) << up_axis_name(up);
  }
}

TEST(ContactDetection, FindsWhatStandsAtEveryFrameRate) {
  const auto skeleton = legs_of_bvh();
  const std::vector<Leg> legs = find_legs(*skeleton);
  for (const double rate : {24.0, 30.0, 60.0, 120.0, 480.0}) {
    const auto frames = static_cast<long>(4 * rate);
    const auto first = static_cast<long>(rate), end = static_cast<long>(2 * rate);
    const auto found =
        find_contacts(legs, flight(*skeleton, frames, rate, first, end), rate, UpAxis::y);
    ASSERT_EQ(found.size(), 1u) << rate;
    EXPECT_EQ(found[0].point, 1);
    EXPECT_NEAR(static_cast<double>(found[0].first), static_cast<double>(first),
                static_cast<double>(contact_unit(rate)));
    EXPECT_NEAR(static_cast<double>(found[0].end), static_cast<double>(end),
                static_cast<double>(contact_unit(rate)));
  }
}

TEST(ContactDetection, LeavesOutWhatIsFastOrHighOrShort) {
  const auto skeleton = legs_of_bvh();
  const std::vector<Leg> legs = find_legs(*skeleton);
  const Eigen::Index toes = joint_named(*skeleton, "left_toes");
  PositionMatrix fast = flight(*skeleton, 240, 60, 60, 120);
  for (Eigen::Index f = 60; f < 120; ++f) fast(f, 3 * toes) += 3 * static_cast<double>(f);
  EXPECT_TRUE(find_contacts(legs, fast, 60, UpAxis::y).empty());
  PositionMatrix high = flight(*skeleton, 240, 60, 60, 120);
  for (Eigen::Index f = 0; f < 60; ++f) high(f, 3 * toes + 1) = -60;
  EXPECT_TRUE(find_contacts(legs, high, 60, UpAxis::y).empty());
  EXPECT_TRUE(find_contacts(legs, flight(*skeleton, 240, 60, 60, 62), 60, UpAxis::y).empty());
}

TEST(ContactDetection, TakesNothingFromEmptyOrVeryShortTakes) {
  const auto skeleton = legs_of_bvh();
  const std::vector<Leg> legs = find_legs(*skeleton);
  EXPECT_TRUE(find_contacts({}, flight(*skeleton, 10, 60, 2, 8), 60, UpAxis::y).empty());
  for (long frames = 0; frames < 4; ++frames) {
    for (const ContactInterval& found :
         find_contacts(legs, flight(*skeleton, frames, 1e6, 0, frames), 1e6, UpAxis::y)) {
      EXPECT_LE(found.end, frames);
    }
  }
}

}  // namespace
}  // namespace reprise
