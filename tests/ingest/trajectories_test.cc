#include "ingest/trajectories.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "archive/space_training.h"
#include "ingest/joint_angles.h"
#include "ingest/skeletons.h"

namespace reprise {
namespace {

namespace skeletons = testing_skeletons;

/// A space of a take that keeps every axis.
CoefficientSpace whole_space(const Take& take) {
  const LayoutEvidence evidence = layout_evidence(prepare_take(take));
  MarkerLayout layout = make_marker_layout(*take.skeleton, choose_layout(*take.skeleton, evidence));
  MarkerMoments moments;
  moments.add(mark_take(layout, take).markers);
  return train_space(std::move(layout), moments, evidence, 1e-9);
}

ChannelMatrix there_and_back(const CoefficientSpace& space, const Take& take) {
  const MarkedTake marked = mark_take(space.layout, take);
  const TrajectoryMatrix trajectories = to_trajectories(space, take, marked);
  const auto decode = [&](const std::vector<BranchSwitch>& switches) {
    return to_channels(space, *take.skeleton, marked.root.tumbles, trajectories, switches);
  };
  return decode(find_branch_switches(space, take, decode({})));
}

double worst_distance(const Take& take, const ChannelMatrix& decoded) {
  return (joint_positions(*take.skeleton, take.channels) - joint_positions(*take.skeleton, decoded))
      .cwiseAbs()
      .maxCoeff();
}

struct Kind {
  const char* name;
  std::shared_ptr<const Skeleton> (*make)();
  int root_joint;
};

class EverySkeleton : public testing::TestWithParam<Kind> {};

TEST_P(EverySkeleton, PositionsComeBack) {
  const Take take = skeletons::swinging_take(GetParam().make(), 200, 35, 3, GetParam().root_joint);
  const CoefficientSpace space = whole_space(take);
  EXPECT_EQ(space.layout.choices.root_joint, GetParam().root_joint);
  EXPECT_LT(worst_distance(take, there_and_back(space, take)), 1e-3);
}

TEST_P(EverySkeleton, AnglesComeBackInTheirOwnBranch) {
  const Take take = skeletons::swinging_take(GetParam().make(), 200, 25, 4, GetParam().root_joint);
  const ChannelMatrix decoded = there_and_back(whole_space(take), take);
  // Joints that nothing hangs on may turn about their own bone as they like only if they carry no
  // marker; every one here does.
  EXPECT_LT((decoded - take.channels).cwiseAbs().maxCoeff(), 1e-2);
}

TEST_P(EverySkeleton, OtherTurnsStayOtherTurns) {
  Take take = skeletons::swinging_take(GetParam().make(), 120, 20, 5, GetParam().root_joint);
  // The last rotation channel of the last joint runs three turns ahead, and one starts in the far
  // branch.
  const Joint* last = nullptr;
  for (const Joint& joint : take.skeleton->joints) {
    if (joint.rotation_slots.size() == 3) last = &joint;
  }
  if (last == nullptr) return;
  take.channels.col(last->first_channel + last->rotation_slots[2]).array() += 1080.0;
  const ChannelMatrix decoded = there_and_back(whole_space(take), take);
  EXPECT_LT((decoded - take.channels).cwiseAbs().maxCoeff(), 1e-2);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, EverySkeleton,
    testing::Values(
        Kind{"chain", [] { return std::shared_ptr<const Skeleton>(skeletons::chain()); }, 0},
        Kind{"branches", [] { return std::shared_ptr<const Skeleton>(skeletons::branches()); }, 0},
        Kind{"without_lengths",
             [] { return std::shared_ptr<const Skeleton>(skeletons::without_lengths()); }, 0},
        Kind{"positions_everywhere",
             [] { return std::shared_ptr<const Skeleton>(skeletons::positions_everywhere()); }, 1},
        Kind{"fingers", [] { return std::shared_ptr<const Skeleton>(skeletons::fingers()); }, 0},
        Kind{"poor_root", [] { return std::shared_ptr<const Skeleton>(skeletons::poor_root()); },
             0},
        Kind{"asf", [] { return std::shared_ptr<const Skeleton>(skeletons::asf()); }, 0}),
    [](const auto& info) { return info.param.name; });

TEST(Trajectories, RepeatedAxesKeepPositions) {
  const Take take = skeletons::swinging_take(skeletons::repeated_axes(), 150, 30, 6);
  EXPECT_LT(worst_distance(take, there_and_back(whole_space(take), take)), 0.5);
}

TEST(Trajectories, SomersaultTakesOutAllSixDegreesOfFreedom) {
  Take take = skeletons::swinging_take(skeletons::branches(), 240, 20, 7);
  const Joint& root = take.skeleton->joints[0];
  for (long f = 0; f < take.frames(); ++f) {
    take.channels(f, root.first_channel + root.rotation_slots[1]) = 3.0 * static_cast<double>(f);
  }
  const CoefficientSpace space = whole_space(take);
  EXPECT_TRUE(mark_take(space.layout, take).root.tumbles);
  const ChannelMatrix decoded = there_and_back(space, take);
  EXPECT_LT(worst_distance(take, decoded), 1e-3);
}

TEST(Trajectories, HeadingsAndOrientationsHaveNoJumps) {
  // Twice round, about the vertical (slot 2) and about the side (slot 1).
  for (const std::size_t slot : {2, 1}) {
    Take take = skeletons::swinging_take(skeletons::branches(), 240, 20, 7);
    const Joint& root = take.skeleton->joints[0];
    for (long f = 0; f < take.frames(); ++f) {
      take.channels(f, root.first_channel + root.rotation_slots[slot]) =
          3.0 * static_cast<double>(f);
    }
    const RootTrack track = mark_take(whole_space(take).layout, take).root;
    ASSERT_EQ(track.tumbles, slot == 1);
    for (long f = 1; f < take.frames(); ++f) {
      if (track.tumbles) {
        EXPECT_GT(track.orientation.row(f).dot(track.orientation.row(f - 1)), 0.9) << f;
      } else {
        EXPECT_NEAR(track.heading[f] - track.heading[f - 1], 0, 0.3) << f;
      }
    }
  }
}

TEST(Trajectories, RootsOfAnAsfMayStandOffTheOrigin) {
  Take take = skeletons::swinging_take(skeletons::asf(), 60, 25, 12);
  auto skeleton = std::make_shared<Skeleton>(*take.skeleton);
  skeleton->joints[0].offset = {1, 20, -3};
  take.skeleton = skeleton;
  const ChannelMatrix decoded = there_and_back(whole_space(take), take);
  EXPECT_LT((decoded - take.channels).cwiseAbs().maxCoeff(), 1e-2);
}

TEST(Trajectories, BranchSwitchesHoldFromTheirFrameOn) {
  const Take take = skeletons::swinging_take(skeletons::chain(), 60, 20, 13);
  const CoefficientSpace space = whole_space(take);
  const MarkedTake marked = mark_take(space.layout, take);
  const TrajectoryMatrix trajectories = to_trajectories(space, take, marked);
  // Half turns of all three angles of a joint are nearly the same rotation again.
  const auto joint = std::ranges::find(space.layout.driven, 2, &DrivenJoint::joint);
  ASSERT_NE(joint, space.layout.driven.end());
  const BranchSwitch half_turns{
      30, static_cast<std::int32_t>(joint - space.layout.driven.begin()), {2, 2, 2}};
  const ChannelMatrix without = to_channels(space, *take.skeleton, false, trajectories, {});
  const ChannelMatrix with = to_channels(space, *take.skeleton, false, trajectories, {half_turns});
  EXPECT_EQ(with.topRows(30), without.topRows(30));
  for (long f = 30; f < take.frames(); ++f) {
    EXPECT_GT((with.row(f) - without.row(f)).cwiseAbs().maxCoeff(), 90) << f;
  }
  EXPECT_LT(worst_distance(take, with), 1e-3);
}

TEST(Trajectories, UprightRootDoesNotTumbleWhateverItsAxes) {
  // The pelvis lies on its side at rest: its X axis points up.
  Take take = skeletons::swinging_take(skeletons::positions_everywhere(), 100, 15, 8, 1);
  const Joint& pelvis = take.skeleton->joints[1];
  take.channels.col(pelvis.first_channel + pelvis.rotation_slots[0]).array() += 90.0;
  const CoefficientSpace space = whole_space(take);
  EXPECT_FALSE(mark_take(space.layout, take).root.tumbles);
  EXPECT_EQ(space.layout.choices.up_axis, 0);
  EXPECT_LT(worst_distance(take, there_and_back(space, take)), 1e-3);
}

TEST(Trajectories, HeadingAndPlaceDoNotChangeMarkers) {
  const Take take = skeletons::swinging_take(skeletons::branches(), 60, 25, 9);
  Take moved = take;
  const Joint& root = take.skeleton->joints[0];
  moved.channels.col(root.first_channel).array() += 300.0;
  const CoefficientSpace space = whole_space(take);
  const MarkerMatrix here = mark_take(space.layout, take).markers;
  EXPECT_LT((here - mark_take(space.layout, moved).markers).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Trajectories, StillTakeHasOneFrameEach) {
  Take take = skeletons::swinging_take(skeletons::branches(), 1, 25, 10);
  EXPECT_LT(worst_distance(take, there_and_back(whole_space(take), take)), 1e-3);
  take.channels = take.channels.replicate(30, 1).eval();
  EXPECT_LT(worst_distance(take, there_and_back(whole_space(take), take)), 1e-3);
}

TEST(JointAngles, LookingNearLeavesAnglesBeyondTheThirdAsTheyAre) {
  const Skeleton skeleton = read_bvh_skeleton(
      "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation "
      "Xrotation Yrotation\nJOINT b\n{\nOFFSET 0 10 0\nCHANNELS 5 Zrotation Xrotation Yrotation "
      "Xrotation Yrotation\nEnd Site\n{\nOFFSET 0 10 0\n}\n}\n}\n",
      "chain");
  LayoutChoices choices;
  choices.active.assign(11, false);
  choices.active[6] = choices.active[7] = true;
  const MarkerLayout layout = make_marker_layout(skeleton, choices);
  const auto chain = std::ranges::find(layout.driven, 1, &DrivenJoint::joint);
  ASSERT_NE(chain, layout.driven.end());
  ASSERT_EQ(chain->rotations.size(), 5u);
  const std::vector<double> start(11, 5.0);
  JointAngleSolver solver(layout, start);
  // Whoever reads on reads what stands behind the three.
  const std::array<double, 5> degrees = {10, 20, 30, 1e6, 1e6};
  solver.look_near(static_cast<std::size_t>(chain - layout.driven.begin()),
                   std::span(degrees).first(3));
  std::vector<double> channels(11, 5.0);
  std::vector<double> markers(static_cast<std::size_t>(layout.dimensions()));
  place_markers(layout, channels, Eigen::Matrix3d::Identity(), markers);
  solver.solve(markers, nullptr, channels);
  EXPECT_NEAR(channels[9], 5.0, 1e-9);
  EXPECT_NEAR(channels[10], 5.0, 1e-9);
}

}  // namespace
}  // namespace reprise
