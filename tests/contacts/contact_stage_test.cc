#include "contacts/contact_stage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "contacts/contact_choice.h"
#include "contacts/legged_skeletons.h"
#include "reprise/model/measure.h"

namespace reprise {
namespace {

using namespace testing_contacts;

constexpr double rate = 60;
constexpr long frames = 240;
constexpr long fade = 6;  // frames of ContactStageConstants::fade_s
constexpr int whole_contact = 3;

class ContactStage : public testing::TestWithParam<std::shared_ptr<const Skeleton> (*)()> {
 protected:
  ContactStage()
      : skeleton_(GetParam()()),
        legs_(find_legs(*skeleton_)),
        plain_(swaying(*skeleton_, frames)) {}

  ChannelMatrix held(const TakeContacts& contacts) const {
    ChannelMatrix channels = plain_;
    apply_contacts(*skeleton_, legs_, rate, contacts, moving_channels(channels), channels);
    return channels;
  }
  Eigen::MatrixX3d path(const ChannelMatrix& channels, int joint) const {
    return joint_positions(*skeleton_, channels).middleCols<3>(3 * joint);
  }
  /// How far (mm) a joint gets away from where it is on average, first .. end - 1.
  double wandering(const ChannelMatrix& channels, int joint, long first, long end) const {
    const Eigen::MatrixX3d places = path(channels, joint).middleRows(first, end - first);
    return (places.rowwise() - places.colwise().mean()).rowwise().norm().maxCoeff();
  }

  std::shared_ptr<const Skeleton> skeleton_;
  std::vector<Leg> legs_;
  ChannelMatrix plain_;
};

INSTANTIATE_TEST_SUITE_P(Formats, ContactStage,
                         testing::Values([] { return legs_of_bvh(); },
                                         []() -> std::shared_ptr<const Skeleton> {
                                           return skeletons::asf();
                                         }));

TEST_P(ContactStage, AFootStaysWhereItStands) {
  const int foot = legs_.at(0).points[0][0];
  const double before = wandering(plain_, foot, 60, 150);
  ASSERT_GT(before, 10);
  EXPECT_LT(wandering(held({{{0, 60, 150}}, whole_contact}), foot, 60, 150), before / 40);
}

TEST_P(ContactStage, NothingButTheLegsAnglesChangesAndOnlyInContactsAndFades) {
  const ChannelMatrix channels = held({{{0, 60, 100}, {0, 104, 150}}, whole_contact});
  EXPECT_GT((channels - plain_).cwiseAbs().maxCoeff(), 0.1);
  EXPECT_EQ(channels.topRows(60 - fade + 1), plain_.topRows(60 - fade + 1));
  const long rest = frames - (150 + fade - 1);
  EXPECT_EQ(channels.bottomRows(rest), plain_.bottomRows(rest));
  for (std::size_t j = 0; j < skeleton_->joints.size(); ++j) {
    const Joint& joint = skeleton_->joints[j];
    const bool turns =
        std::ranges::find(legs_[0].joints, static_cast<int>(j)) != legs_[0].joints.end();
    for (std::size_t k = 0; k < joint.channels.size(); ++k) {
      if (turns && is_rotation(joint.channels[k])) continue;
      const auto channel = joint.first_channel + static_cast<Eigen::Index>(k);
      EXPECT_EQ(channels.col(channel), plain_.col(channel)) << joint.name;
    }
  }
}

TEST_P(ContactStage, BonesKeepTheirLengths) {
  const PositionMatrix before = joint_positions(*skeleton_, plain_);
  const PositionMatrix after = joint_positions(*skeleton_, held({{{0, 60, 150}}, whole_contact}));
  for (std::size_t j = 1; j < skeleton_->joints.size(); ++j) {
    const auto own = 3 * static_cast<Eigen::Index>(j);
    const Eigen::Index parent = 3 * skeleton_->joints[j].parent;
    const auto lengths = [&](const PositionMatrix& places) -> Eigen::VectorXd {
      return (places.middleCols<3>(own) - places.middleCols<3>(parent)).rowwise().norm();
    };
    EXPECT_LT((lengths(after) - lengths(before)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST_P(ContactStage, AFadeIsNoJump) {
  const int foot = legs_.at(0).points[0][0];
  const Eigen::MatrixX3d moved =
      path(held({{{0, 60, 150}}, whole_contact}), foot) - path(plain_, foot);
  const double most = moved.rowwise().norm().maxCoeff();
  // A cubic from rest to rest is steepest in its middle, 1.5 of its mean slope.
  const double step =
      (moved.bottomRows(frames - 1) - moved.topRows(frames - 1)).rowwise().norm().maxCoeff();
  EXPECT_LT(step, 2 * most / static_cast<double>(fade));
}

TEST_P(ContactStage, ALegThatIsTooShortReachesAsFarAsItCan) {
  const int foot = legs_.at(0).points[0][0];
  Eigen::Index height = 0;
  while (skeleton_->joints[0].channels[static_cast<std::size_t>(height)] != Channel::y_position) {
    ++height;
  }
  // The body jumps up by 2 m while its foot stands.
  for (long f = 60; f < 150; ++f) {
    plain_(f, height) += std::sin((static_cast<double>(f) - 60) / 90 * 3.14159) * 2000 /
                         skeleton_->millimetres_per_unit;
  }
  const ChannelMatrix channels = held({{{0, 60, 150}}, whole_contact});
  ASSERT_TRUE(channels.allFinite());
  EXPECT_LT(wandering(channels, foot, 60, 150), wandering(plain_, foot, 60, 150) + 1);
  EXPECT_LT((channels - plain_).cwiseAbs().maxCoeff(), 360);
}

TEST_P(ContactStage, AnglesThatNeverMoveStay) {
  for (const int joint : legs_.at(0).joints) {
    const Joint& turns = skeleton_->joints[static_cast<std::size_t>(joint)];
    const auto count = static_cast<Eigen::Index>(turns.channels.size());
    plain_.middleCols(turns.first_channel, count).rowwise() =
        plain_.row(0).middleCols(turns.first_channel, count).eval();
  }
  EXPECT_EQ(held({{{0, 60, 150}}, whole_contact}), plain_);
}

TEST_P(ContactStage, SteadyFeetMoveLessAndNothingElseDoes) {
  // A foot that shakes, by 2 degrees of its hip.
  const int hip = legs_.at(0).joints.front();
  const Joint& joint = skeleton_->joints[static_cast<std::size_t>(hip)];
  const Eigen::Index angle = joint.first_channel + joint.rotation_slots.front();
  for (long f = 0; f < frames; ++f) plain_(f, angle) += std::sin(0.4 * static_cast<double>(f));
  ChannelMatrix channels = plain_;
  const std::vector<bool> all(static_cast<std::size_t>(plain_.cols()), true);
  const TakeContacts contacts{{{0, 60, 150}}, 2};
  steady_contacts(*skeleton_, legs_, rate, contacts, all, channels);
  const int foot = legs_[0].points[0][0];
  const auto shaking = [&](const ChannelMatrix& of) {
    const Eigen::MatrixX3d places = path(of, foot).middleRows(70, 70);
    return (places.topRows(68) - 2 * places.middleRows(1, 68) + places.bottomRows(68))
        .rowwise()
        .norm()
        .mean();
  };
  EXPECT_LT(shaking(channels), shaking(plain_) / 3);
  EXPECT_EQ(channels.topRows(61), plain_.topRows(61));
  EXPECT_EQ(channels.bottomRows(frames - 149), plain_.bottomRows(frames - 149));
  // No step where a contact begins and ends.
  const Eigen::MatrixX3d moved = path(channels, foot) - path(plain_, foot);
  EXPECT_LT(moved.row(61).norm(), moved.rowwise().norm().maxCoeff() / 5);
  EXPECT_LT(moved.row(148).norm(), moved.rowwise().norm().maxCoeff() / 5);
  std::vector<bool> none(all.size(), false);
  ChannelMatrix still = plain_;
  steady_contacts(*skeleton_, legs_, rate, contacts, none, still);
  EXPECT_EQ(still, plain_);
}

TEST_P(ContactStage, SteadyFeetMoveAtTheEndsOfATakeAndFollowAStraightPath) {
  // All moves on at one speed: nothing is to be smoothed but at the take's own ends.
  plain_.rowwise() = plain_.row(0).eval();
  for (long f = 0; f < frames; ++f) plain_(f, 0) += static_cast<double>(f) / 100;
  ChannelMatrix channels = plain_;
  const std::vector<bool> all(static_cast<std::size_t>(plain_.cols()), true);
  for (int hold = 0; hold < 1 << TakeContacts::hold_bits; ++hold) {
    steady_contacts(*skeleton_, legs_, rate, {{{0, 60, 150}}, hold}, all, channels);
    EXPECT_LT((channels - plain_).cwiseAbs().maxCoeff(), 1e-6);
  }
  steady_contacts(*skeleton_, legs_, rate, {{{0, 0, frames}}, 1}, all, channels);
  const int foot = legs_[0].points[0][0];
  EXPECT_GT((path(channels, foot) - path(plain_, foot)).row(0).norm(), 0.1);
}

TEST_P(ContactStage, HugeNumbersStayFinite) {
  for (const double huge : {1e30, 1e160, 1e300}) {
    ChannelMatrix wild = plain_ * huge, held = wild;
    const std::vector<bool> all(static_cast<std::size_t>(wild.cols()), true);
    steady_contacts(*skeleton_, legs_, rate, {{{0, 0, frames}}, 1}, all, wild);
    EXPECT_TRUE(wild.allFinite());
    apply_contacts(*skeleton_, legs_, rate, {{{0, 60, 150}}, 1}, moving_channels(held), held);
    EXPECT_TRUE(held.allFinite());
  }
}

TEST_P(ContactStage, AreChosenAsStillAsTheSourceAndNotWhereTheyAreNotNeeded) {
  TakeContacts all{{}, whole_contact};
  for (int p = 0; p < count_points(legs_); ++p) all.intervals.push_back({p, 0, frames});
  const PositionMatrix standing = joint_positions(*skeleton_, held(all));
  const TakeContacts chosen = choose_contacts(*skeleton_, legs_, rate, standing, plain_);
  ASSERT_FALSE(chosen.intervals.empty());
  EXPECT_EQ(chosen.hold, whole_contact);
  const PositionMatrix sliding = joint_positions(*skeleton_, plain_);
  EXPECT_TRUE(choose_contacts(*skeleton_, legs_, rate, sliding, plain_).intervals.empty());
}

TEST(MovingChannels, AreThoseThatChange) {
  ChannelMatrix channels = ChannelMatrix::Constant(5, 3, 1.5);
  channels(3, 1) = 2;
  EXPECT_EQ(moving_channels(channels), (std::vector<bool>{false, true, false}));
  EXPECT_EQ(moving_channels(ChannelMatrix(0, 3)), std::vector<bool>(3, false));
}

}  // namespace
}  // namespace reprise
