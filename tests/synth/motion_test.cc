// That the motion is a person's: feet hold, joints keep to their limits, and repeats look alike.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "reprise/model/kinematics.h"
#include "reprise/model/measure.h"
#include "reprise/synth/library.h"
#include "synth/behaviours.h"
#include "synth/channels.h"
#include "synth/poses.h"
#include "synth/skeleton_text.h"

namespace reprise {
namespace {

using Eigen::Vector3d;

const SynthLibrary& library() {
  static const SynthLibrary made = [] {
    SynthOptions options;
    options.takes = 16;
    return make_synthetic_library(options);
  }();
  return made;
}

int joint_named(const Skeleton& skeleton, const std::string& name) {
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (skeleton.joints[j].name == name) return static_cast<int>(j);
  }
  ADD_FAILURE() << "no joint " << name;
  return 0;
}

Vector3d place(const PositionMatrix& positions, long frame, int joint) {
  return positions.row(frame).segment<3>(3 * joint).transpose();
}

/// Joint places with the pelvis's place and heading taken out, at evenly spaced times of an
/// interval.
PositionMatrix aligned_clip(const Take& take, const Skeleton& body, double start, double end) {
  constexpr long samples = 40;
  ChannelMatrix channels(samples, take.channels.cols());
  for (long i = 0; i < samples; ++i) {
    const double time = start + (end - start) * static_cast<double>(i) / samples;
    channels.row(i) = take.channels.row(std::lround(time * take.frame_rate));
  }
  PositionMatrix positions = joint_positions(body, channels);
  const int left = joint_named(body, "LeftUpLeg"), right = joint_named(body, "RightUpLeg");
  for (long i = 0; i < samples; ++i) {
    const Vector3d across = place(positions, i, left) - place(positions, i, right);
    const Vector3d middle = 0.5 * (place(positions, i, left) + place(positions, i, right));
    const Eigen::Matrix3d turn = axis_rotation(1, std::atan2(across.z(), across.x()));
    for (long j = 0; j < positions.cols() / 3; ++j) {
      positions.row(i).segment<3>(3 * j) =
          (turn * (place(positions, i, static_cast<int>(j)) - middle)).transpose();
    }
  }
  return positions;
}

double mean_distance(const PositionMatrix& a, const PositionMatrix& b) {
  return position_errors(a, b).mean;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

TEST(SynthMotion, RepeatsAreAlikeAndOtherMotionsAreNot) {
  std::map<std::string, const Take*> takes;
  for (const Take& take : library().takes) takes[take.name] = &take;
  const Skeleton& body = *library().takes[0].skeleton;  // one body, so that only the motion counts
  std::vector<PositionMatrix> motions;
  std::vector<double> repeats, others;
  for (const auto& group : library().truth) {
    const auto clip = [&](const SynthOccurrence& occurrence) {
      return aligned_clip(*takes[occurrence.file], body, occurrence.start_s, occurrence.end_s);
    };
    motions.push_back(clip(group[0]));
    for (std::size_t i = 1; i < group.size(); ++i) {
      if (group[i].noise <= 1) repeats.push_back(mean_distance(motions.back(), clip(group[i])));
    }
  }
  for (std::size_t i = 0; i < motions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) others.push_back(mean_distance(motions[i], motions[j]));
  }
  ASSERT_GE(repeats.size(), 8u);
  EXPECT_LT(*std::max_element(repeats.begin(), repeats.end()), 60) << "mm";
  EXPECT_GT(median(others), 100) << "mm";
  EXPECT_LT(4 * median(repeats), median(others));
}

TEST(SynthMotion, FeetStayOnTheFloorAndHoldThere) {
  std::vector<double> skating;
  for (const Take& take : library().takes) {
    const PositionMatrix positions = joint_positions(*take.skeleton, take.channels);
    double lowest = 1e9;
    std::vector<double> feet;
    for (long i = 0; i < positions.rows(); ++i) {
      double low = 1e9;
      for (long j = 0; j < positions.cols() / 3; ++j) low = std::min(low, positions(i, 3 * j + 1));
      lowest = std::min(lowest, low);
      feet.push_back(low);
    }
    EXPECT_GT(lowest, -50) << take.name;
    EXPECT_NEAR(median(feet), 10, 12) << take.name;
    const auto skate = foot_skate(*take.skeleton, positions, positions, take.frame_rate);
    ASSERT_TRUE(skate.has_value());
    EXPECT_LT(skate->original, 90) << take.name;
    skating.push_back(skate->original);
  }
  EXPECT_LT(median(skating), 50) << "mm/s; captured takes have 20 to 50";
}

TEST(SynthMotion, HipsStayWhereAPersonHasThem) {
  for (const Take& take : library().takes) {
    const Eigen::VectorXd height = take.channels.col(1) * take.skeleton->millimetres_per_unit;
    EXPECT_GT(height.minCoeff(), 350) << take.name;
    EXPECT_LT(height.maxCoeff(), 1400) << take.name;
    EXPECT_NEAR(height.mean(), 920, 110) << take.name;
  }
}

TEST(SynthMotion, JointsKeepToTheirLimits) {
  SynthOptions options;
  options.takes = 4;
  options.format = MotionFormat::asf_amc;
  for (const Take& take : make_synthetic_library(options).takes) {
    for (int joint = 1; joint < synth::joint_count; ++joint) {
      const auto& described = synth::describe(joint);
      const Joint& bone =
          take.skeleton
              ->joints[static_cast<std::size_t>(joint_named(*take.skeleton, described.asf_name))];
      for (std::size_t c = 0; c < bone.channels.size(); ++c) {
        const auto& limits = described.limits[static_cast<std::size_t>(axis_of(bone.channels[c]))];
        const auto values = take.channels.col(bone.first_channel + static_cast<long>(c));
        EXPECT_GE(values.minCoeff(), limits.low - 1e-3) << take.name << ' ' << bone.name;
        EXPECT_LE(values.maxCoeff(), limits.high + 1e-3) << take.name << ' ' << bone.name;
      }
    }
  }
}

TEST(SynthMotion, BothFormatsShowTheSameBody) {
  synth::Random random(5);
  const synth::Proportions body = synth::random_proportions(random.fork(1));
  const synth::Performance performance = synth::perform(synth::Behaviour::throw_ball, random);
  const synth::PoseMatrix poses =
      synth::pose_body(performance.tracks(), synth::Performance::rate, body, {});
  const auto bvh = synth::make_skeleton(MotionFormat::bvh, body, "a");
  const auto asf = synth::make_skeleton(MotionFormat::asf_amc, body, "a");
  const PositionMatrix as_bvh = joint_positions(*bvh, synth::make_channels(poses, *bvh));
  const PositionMatrix as_amc = joint_positions(*asf, synth::make_channels(poses, *asf));
  // A BVH joint stands at its own place, an ASF bone at its far end.
  const std::pair<const char*, const char*> same[] = {
      {"LeftHand", "lradius"}, {"RightForeArm", "rhumerus"}, {"Head", "lowerneck"},
      {"LeftFoot", "ltibia"},  {"RightToeBase", "rfoot"},    {"Chest", "upperback"}};
  for (const auto& [joint, bone] : same) {
    for (long i = 0; i < poses.rows(); ++i) {
      const Vector3d a = place(as_bvh, i, joint_named(*bvh, joint));
      const Vector3d b = place(as_amc, i, joint_named(*asf, bone));
      ASSERT_LT((a - b).norm(), 0.1) << joint << " in frame " << i << ", mm";
    }
  }
}

class SynthWalk : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(SynthWalk, GoesAtAWalkingPaceOnFeetThatHold) {
  synth::Random random(GetParam());
  const synth::Proportions body = synth::random_proportions(random.fork(1));
  const synth::GaitStyle style = synth::random_walk_style(random);
  const synth::Performance walk = synth::perform_steps(style, 10, 40, 0, synth::Side::left);
  const double rate = synth::Performance::rate;
  const auto& tracks = walk.tracks();
  const synth::PoseMatrix poses = synth::pose_body(tracks, rate, body, {});
  const long from = walk.samples() / 3, to = 2 * walk.samples() / 3;
  const double way = std::hypot(poses(to, synth::root_x) - poses(from, synth::root_x),
                                poses(to, synth::root_z) - poses(from, synth::root_z));
  const double speed = way / (static_cast<double>(to - from) / rate);
  EXPECT_GT(speed, 850) << "mm/s";
  EXPECT_LT(speed, 1700) << "mm/s";

  const auto skeleton = synth::make_skeleton(MotionFormat::bvh, body, "a");
  const PositionMatrix positions =
      joint_positions(*skeleton, synth::make_channels(poses, *skeleton));
  long standing = 0;
  for (const auto& [side, name] :
       {std::pair{synth::Side::left, "LeftToeBase"}, {synth::Side::right, "RightToeBase"}}) {
    const int ball = joint_named(*skeleton, name);
    const int lift = synth::foot_track(side, synth::foot_lift);
    const int pitch = synth::foot_track(side, synth::foot_pitch);
    for (long i = 1; i < walk.samples(); ++i) {
      const bool down = tracks.col(lift).segment(i - 1, 2).maxCoeff() == 0 &&
                        tracks(i - 1, pitch) >= 0 && tracks(i, pitch) >= 0;
      if (!down) continue;
      ++standing;
      EXPECT_LT((place(positions, i, ball) - place(positions, i - 1, ball)).norm() * rate, 40)
          << name << ' ' << i;
    }
  }
  EXPECT_GT(standing, walk.samples() / 2) << "one foot is on the floor at all times";
}

INSTANTIATE_TEST_SUITE_P(Styles, SynthWalk, ::testing::Range<std::uint64_t>(1, 9));

TEST(SynthMotion, EveryBehaviourIsSmoothAndEndsAtRest) {
  const synth::Proportions body = synth::random_proportions(synth::Random(3));
  for (int kind = 0; kind < static_cast<int>(synth::Behaviour::count); ++kind) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      for (const double most : {1.2, 4.0}) {
        synth::Random random(seed);
        const synth::Performance p =
            synth::perform(static_cast<synth::Behaviour>(kind), random, most);
        EXPECT_GE(p.seconds(), 0.98) << kind;
        EXPECT_LE(p.seconds(), 4.5) << kind;
        const synth::PoseMatrix poses =
            synth::pose_body(p.tracks(), synth::Performance::rate, body, {});
        ASSERT_TRUE(poses.allFinite()) << kind;
        const long n = poses.rows();
        const auto angles = poses.rightCols(synth::pose_columns - synth::root_yaw);
        const double step =
            (angles.bottomRows(n - 1) - angles.topRows(n - 1)).cwiseAbs().maxCoeff();
        EXPECT_LT(step, 40) << "degrees a frame, behaviour " << kind << " seed " << seed;
        EXPECT_LT((angles.row(1) - angles.row(0)).cwiseAbs().maxCoeff(), 3.5)
            << kind << ' ' << seed;
        EXPECT_LT((angles.row(n - 1) - angles.row(n - 2)).cwiseAbs().maxCoeff(), 3.5)
            << kind << ' ' << seed;
      }
    }
  }
}

}  // namespace
}  // namespace reprise
