#include "reprise/query/take_reading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edited_motion.h"

namespace reprise {
namespace {

TakeReading reading_of(const Take& take, const ReadOptions& options = {}) {
  const ReadingEvidence evidence = reading_evidence(take);
  return find_reading(*take.skeleton, {&evidence, 1}, options);
}

/// Under names that say nothing.
Take nameless(const Take& take) {
  return edited::renamed(take, [](const std::string& name) { return "Prop" + name.substr(0, 1); });
}

TEST(TakeReading, TheUnitIsTheOneThatMakesABodyAsTallAsPeopleAre) {
  for (const Take& take : edited::synthetic_takes(3, 3)) {
    for (const double unit : {1000.0, 100.0, 10.0, 25.4, 1.0, 25.4 / 0.45}) {
      const TakeReading reading = reading_of(edited::in_unit(take, unit));
      EXPECT_NEAR(reading.millimetres_per_unit, unit, 1e-6 * unit);
      EXPECT_TRUE(reading.unit_assumed);
      ASSERT_TRUE(reading.height_mm);
      EXPECT_GT(*reading.height_mm, 1450);
      EXPECT_LT(*reading.height_mm, 2000);
    }
  }
}

TEST(TakeReading, TheHeightDoesNotDependOnThePosture) {
  const Take take = edited::synthetic_takes(1, 3)[0];
  const double expected = *reading_of(take).height_mm;
  for (const double degrees : {30.0, 70.0, 110.0}) {
    Take bent = take;
    for (const Joint& joint : take.skeleton->joints) {
      if (joint.parent < 0) continue;
      for (std::size_t c = 0; c < joint.channels.size(); ++c) {
        if (joint.channels[c] == Channel::x_rotation) {
          bent.channels.col(joint.first_channel + static_cast<Eigen::Index>(c)).array() += degrees;
        }
      }
    }
    EXPECT_NEAR(*reading_of(bent).height_mm, expected, 1e-6 * expected);
  }
}

TEST(TakeReading, WhatIsSaidComesFirst) {
  ReadOptions options;
  options.bvh_millimetres_per_unit = 25.4;
  options.up = UpAxis::minus_x;
  const TakeReading reading = reading_of(edited::synthetic_takes(1, 2)[0], options);
  EXPECT_EQ(reading.millimetres_per_unit, 25.4);
  EXPECT_EQ(reading.up, UpAxis::minus_x);
  EXPECT_FALSE(reading.unit_assumed);
  EXPECT_FALSE(reading.up_assumed);
}

TEST(TakeReading, AnAsfSaysItsUnitItself) {
  const Take take = edited::synthetic_takes(1, 2, MotionFormat::asf_amc)[0];
  const TakeReading reading = reading_of(take);
  EXPECT_EQ(reading.millimetres_per_unit, take.skeleton->millimetres_per_unit);
  EXPECT_FALSE(reading.unit_assumed);
  EXPECT_TRUE(reading.is_plausible());
  Take giant = take;
  auto skeleton = std::make_shared<Skeleton>(*take.skeleton);
  skeleton->millimetres_per_unit *= 25.4;
  giant.skeleton = skeleton;
  EXPECT_FALSE(reading_of(giant).is_plausible());
  EXPECT_EQ(reading_of(giant).millimetres_per_unit, skeleton->millimetres_per_unit);
}

TEST(TakeReading, WithoutABodyTheUnitIsTheMostCommonOne) {
  const Take take = edited::synthetic_takes(1, 2)[0];
  const Take prop = edited::in_unit(edited::with_skeleton(nameless(take),
                                                          [](Skeleton& skeleton) {
                                                            for (Joint& joint : skeleton.joints)
                                                              joint.offset.x() = 7;
                                                          }),
                                    1000);
  const TakeReading reading = reading_of(prop);
  EXPECT_EQ(reading.millimetres_per_unit, default_millimetres_per_unit);
  EXPECT_TRUE(reading.unit_assumed);
  EXPECT_FALSE(reading.height_mm);
  EXPECT_FALSE(reading.is_plausible());
  // And where no unit makes it a body that there is.
  const TakeReading dwarf = reading_of(edited::in_unit(take, 3000));
  EXPECT_EQ(dwarf.millimetres_per_unit, default_millimetres_per_unit);
  EXPECT_TRUE(dwarf.unit_assumed);
  EXPECT_FALSE(dwarf.is_plausible());
}

TEST(TakeReading, UpIsWhereHeadsAreAboveFeet) {
  for (const MotionFormat format : {MotionFormat::bvh, MotionFormat::asf_amc}) {
    const Take take = edited::synthetic_takes(1, 3, format)[0];
    for (const UpAxis up : edited::every_up) {
      const TakeReading reading = reading_of(edited::turned(take, up));
      EXPECT_EQ(reading.up, up) << up_axis_name(up);
      EXPECT_TRUE(reading.up_assumed);
      EXPECT_NEAR(*reading.height_mm, *reading_of(take).height_mm, 1e-6);
    }
  }
}

TEST(TakeReading, TheMotionSaysWhatIsUpWhereTheRestPoseLies) {
  // Only the root is turned: the rest pose stays as it is.
  const Take take = edited::synthetic_takes(1, 3)[0];
  Take lying = take;
  const Joint& root = take.skeleton->joints[0];
  for (std::size_t c = 0; c < root.channels.size(); ++c) {
    const Eigen::Index channel = root.first_channel + static_cast<Eigen::Index>(c);
    if (is_rotation(root.channels[c])) lying.channels.col(channel).setZero();
    if (root.channels[c] == Channel::x_rotation) lying.channels.col(channel).setConstant(90);
  }
  const TakeReading reading = reading_of(lying);
  EXPECT_EQ(reading.up, UpAxis::z);
}

TEST(TakeReading, TheRestPoseSaysWhatIsUpWhereTheMotionTumbles) {
  const Take take = edited::synthetic_takes(1, 3)[0];
  for (const UpAxis up : {UpAxis::z, UpAxis::minus_y}) {
    Take tumbling = edited::turned(take, up);
    const Joint& root = tumbling.skeleton->joints[0];
    for (std::size_t c = 0; c < root.channels.size(); ++c) {
      if (root.channels[c] != Channel::x_rotation) continue;
      for (Eigen::Index f = 0; f < take.frames(); ++f) {
        tumbling.channels(f, root.first_channel + static_cast<Eigen::Index>(c)) +=
            1080.0 * static_cast<double>(f) / static_cast<double>(take.frames());
      }
    }
    EXPECT_EQ(reading_of(tumbling).up, up) << up_axis_name(up);
  }
}

TEST(TakeReading, AllTakesOfATextAreAskedInAnyOrder) {
  std::vector<ReadingEvidence> takes;
  Skeleton skeleton;
  for (const Take& take : edited::synthetic_takes(4, 3)) {
    takes.push_back(reading_evidence(edited::turned(take, UpAxis::z)));
    skeleton = *take.skeleton;
  }
  // One lies down all the time.
  takes.push_back(reading_evidence(edited::synthetic_takes(1, 2)[0]));
  const TakeReading expected = find_reading(skeleton, takes, {});
  EXPECT_EQ(expected.up, UpAxis::z);
  std::ranges::reverse(takes);
  const TakeReading reversed = find_reading(skeleton, takes, {});
  EXPECT_EQ(reversed.up, expected.up);
  EXPECT_EQ(reversed.height_mm, expected.height_mm);
}

TEST(UpAxes, HaveNames) {
  for (const UpAxis up : edited::every_up) EXPECT_EQ(find_up_axis(up_axis_name(up)), up);
  EXPECT_EQ(find_up_axis("-Z"), UpAxis::minus_z);
  for (const char* text : {"", "w", "+y", "y ", "--y"}) EXPECT_FALSE(find_up_axis(text)) << text;
}

TEST(UpAxes, AreTurnedToYByRotationsOfWholeNumbers) {
  for (const UpAxis up : edited::every_up) {
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();
    axis[static_cast<int>(up) % 3] = static_cast<int>(up) < 3 ? 1 : -1;
    EXPECT_EQ(turn_to_y(up) * axis, Eigen::Vector3d::UnitY());
    EXPECT_EQ(turn_to_y(up).determinant(), 1);
  }
}

}  // namespace
}  // namespace reprise
