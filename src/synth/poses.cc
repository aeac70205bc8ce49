#include "synth/poses.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace reprise::synth {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A leg is never quite straight: the longest hip to ankle distance, as a share of the leg.
constexpr double longest_reach = 0.995;
/// Seconds over which the pelvis sinks where a foot would be out of reach.
constexpr double sink_seconds = 0.10;
/// Each torso joint follows the one below a little later (seconds), with these shares of the whole
/// bend.
constexpr double follow_seconds = 0.035;
constexpr double torso_share[] = {0.34, 0.34, 0.32};
constexpr double head_share[] = {0.45, 0.55};

struct LegJoints {
  int thigh, shank, foot, toes;
};
constexpr LegJoints legs[] = {{left_up_leg, left_leg, left_foot, left_toe_base},
                              {right_up_leg, right_leg, right_foot, right_toe_base}};
struct ArmJoints {
  int clavicle, upper, lower, hand;
};
constexpr ArmJoints arms[] = {{left_shoulder, left_arm, left_fore_arm, left_hand},
                              {right_shoulder, right_arm, right_fore_arm, right_hand}};

/// Where the ankle is: the foot turns about its ball when the heel is up, about the heel when the
/// toes are.
Vector3d ankle_place(const TrackMatrix& tracks, long frame, Side side, const Proportions& body) {
  const auto value = [&](FootTrack track) { return tracks(frame, foot_track(side, track)); };
  const double pitch = value(foot_pitch);
  const Vector3d ball = body.offset[legs[static_cast<int>(side)].toes];
  const Vector3d pivot = pitch > 0 ? ball : Vector3d(0, -body.ankle_height, -0.35 * ball.z());
  const Matrix3d yaw = rotation_zyx(0, value(foot_yaw), 0);
  const Vector3d ground(value(foot_x) * body.leg(), value(foot_lift) * body.leg(),
                        value(foot_z) * body.leg());
  return ground + Vector3d(0, body.ankle_height, 0) +
         yaw * (pivot - rotation_zyx(pitch, 0, 0) * pivot);
}

Vector3d root_place(const TrackMatrix& tracks, long frame, const Proportions& body) {
  return {tracks(frame, pelvis_x) * body.leg(),
          tracks(frame, pelvis_rise) * body.leg() + body.standing_height(),
          tracks(frame, pelvis_z) * body.leg()};
}

/// How much too high the pelvis is for a leg, in mm.
double overreach(const Vector3d& hip, const Vector3d& ankle, double leg) {
  const double reach = longest_reach * leg;
  const double across = std::hypot(ankle.x() - hip.x(), ankle.z() - hip.z());
  const double height = std::sqrt(std::max(reach * reach - across * across, 0.04 * leg * leg));
  return std::max(0.0, hip.y() - ankle.y() - height);
}

/// Per frame, how far the pelvis has to sink (mm), smoothly.
Eigen::VectorXd sinking(const TrackMatrix& tracks, double frame_rate, const Proportions& body) {
  const long n = tracks.rows();
  Eigen::VectorXd needed(n), sink(n);
  for (long i = 0; i < n; ++i) {
    const Matrix3d pelvis =
        root_rotation(tracks(i, pelvis_yaw), tracks(i, pelvis_pitch), tracks(i, pelvis_roll));
    const Vector3d root = root_place(tracks, i, body);
    needed[i] = 0;
    for (const Side side : {Side::left, Side::right}) {
      const Vector3d hip = root + pelvis * body.offset[legs[static_cast<int>(side)].thigh];
      needed[i] =
          std::max(needed[i], overreach(hip, ankle_place(tracks, i, side, body), body.leg()));
    }
  }
  const long window = std::max(1L, std::lround(sink_seconds * frame_rate));
  for (long i = 0; i < n; ++i) {
    const long first = std::max(0L, i - window), last = std::min(n - 1, i + window);
    sink[i] = needed.segment(first, last - first + 1).maxCoeff();
  }
  smooth_column(sink, 0.5 * sink_seconds * frame_rate);
  return sink;
}

/// Two-bone inverse kinematics: the knee bends in the plane of the leg and the foot's direction.
void pose_leg(const TrackMatrix& tracks, long frame, Side side, const Matrix3d& pelvis,
              const Vector3d& root, const Proportions& body, PoseMatrix& poses) {
  const LegJoints& leg = legs[static_cast<int>(side)];
  const double yaw = tracks(frame, foot_track(side, foot_yaw));
  const double pitch = tracks(frame, foot_track(side, foot_pitch));
  const double lift = tracks(frame, foot_track(side, foot_lift));
  const Vector3d hip = root + pelvis * body.offset[leg.thigh];
  const Vector3d to_ankle = ankle_place(tracks, frame, side, body) - hip;
  const double distance =
      std::clamp(to_ankle.norm(), 0.25 * body.leg(), longest_reach * body.leg());
  const Vector3d down = to_ankle.normalized();
  const Matrix3d foot_turn = rotation_zyx(0, yaw, 0);
  const Vector3d forward = foot_turn.col(2) + 0.35 * pelvis.col(2);
  const Vector3d hinge = (-down).cross(forward).normalized();
  const Vector3d front = hinge.cross(-down);
  const double cos_hip = (body.thigh * body.thigh + distance * distance - body.shank * body.shank) /
                         (2 * body.thigh * distance);
  const double cos_knee =
      (body.thigh * body.thigh + body.shank * body.shank - distance * distance) /
      (2 * body.thigh * body.shank);
  const double at_hip = std::acos(std::clamp(cos_hip, -1.0, 1.0));
  const double knee = 180 - std::acos(std::clamp(cos_knee, -1.0, 1.0)) / radians_per_degree;
  Matrix3d thigh;
  thigh.col(0) = hinge;
  thigh.col(1) = -(std::cos(at_hip) * down + std::sin(at_hip) * front);
  thigh.col(2) = hinge.cross(thigh.col(1));
  const Matrix3d shank = thigh * rotation_zyx(knee, 0, 0);
  const Matrix3d foot = foot_turn * rotation_zyx(pitch, 0, 0);
  const auto set = [&](int joint, const Vector3d& angles) {
    poses.row(frame).segment<3>(angle_column(joint)) = angles.transpose();
  };
  set(leg.thigh, angles_zyx(pelvis.transpose() * thigh));
  set(leg.shank, {knee, 0, 0});
  set(leg.foot, angles_zyx(shank.transpose() * foot));
  // Toes stay flat on the floor while the heel rises, and straighten in the air.
  set(leg.toes, {-std::max(0.0, pitch) * (1 - minimum_jerk(lift / 0.20)) - 3, 0, 0});
}

/// A track some time ago.
double delayed(const TrackMatrix& tracks, long frame, int track, double frames) {
  const double place = std::max(0.0, static_cast<double>(frame) - frames);
  const long before = static_cast<long>(place);
  const double u = place - static_cast<double>(before);
  return u == 0 ? tracks(before, track)
                : (1 - u) * tracks(before, track) + u * tracks(before + 1, track);
}

void pose_torso(const TrackMatrix& tracks, long frame, double frame_rate, const Posture& posture,
                PoseMatrix& poses) {
  for (int k = 0; k < 3; ++k) {
    const double late = k * follow_seconds * frame_rate;
    const int column = angle_column(spine + k);
    poses(frame, column) =
        torso_share[k] * (delayed(tracks, frame, torso_pitch, late) + posture.torso_pitch);
    poses(frame, column + 1) = torso_share[k] * delayed(tracks, frame, torso_twist, late);
    poses(frame, column + 2) = torso_share[k] * delayed(tracks, frame, torso_side, late);
  }
  for (int k = 0; k < 2; ++k) {
    const double late = (1 - k) * follow_seconds * frame_rate;  // the head leads the neck
    const int column = angle_column(neck + k);
    poses(frame, column) =
        head_share[k] * (delayed(tracks, frame, head_pitch, late) + posture.head_pitch);
    poses(frame, column + 1) = head_share[k] * delayed(tracks, frame, head_twist, late);
    poses(frame, column + 2) = head_share[k] * delayed(tracks, frame, head_side, late);
  }
}

void pose_arm(const TrackMatrix& tracks, long frame, Side side, const Posture& posture,
              PoseMatrix& poses) {
  const ArmJoints& arm = arms[static_cast<int>(side)];
  const double mirror = sign_of(side);
  const auto value = [&](ArmTrack track) { return tracks(frame, arm_track(side, track)); };
  // Arms that hang are held out by the posture; raised ones are not.
  const double hanging = std::clamp((0 - value(arm_z)) / 75, 0.0, 1.0);
  const auto set = [&](int joint, double x, double y, double z) {
    poses.row(frame).segment<3>(angle_column(joint)) << x, mirror * y, mirror * z;
  };
  set(arm.clavicle, 0, value(clavicle_y) - posture.shoulders_forward, value(clavicle_z));
  set(arm.upper, value(arm_x), value(arm_y), value(arm_z) + hanging * posture.arms_out);
  set(arm.lower, value(elbow) + hanging * posture.elbows, 0, 0);
  set(arm.hand, value(hand_x), 0, value(hand_z));
}

/// How much a foot counts as standing; never nothing, so that someone in the air has a place too.
double standing_weight(const TrackMatrix& tracks, long frame, Side side) {
  const double up = tracks(frame, foot_track(side, foot_lift)) / 0.02;
  return 0.02 + std::exp(-up * up);
}

/// Place of the ankle and of the ball of a foot by forward kinematics, averaged.
Vector3d foot_place(const PoseMatrix& poses, long frame, Side side, const Proportions& body) {
  const LegJoints& leg = legs[static_cast<int>(side)];
  Matrix3d turn =
      root_rotation(poses(frame, root_yaw), poses(frame, root_pitch), poses(frame, root_roll));
  Vector3d place = poses.row(frame).segment<3>(root_x).transpose();
  for (const int joint : {leg.thigh, leg.shank, leg.foot}) {
    place += turn * body.offset[joint];
    turn *= joint_rotation(joint, poses.row(frame).segment<3>(angle_column(joint)).transpose());
  }
  return place + 0.5 * turn * body.offset[leg.toes];
}

}  // namespace

Posture random_posture(Random random) {
  Posture posture;
  posture.torso_pitch = random.uniform(-4, 7);
  posture.head_pitch = random.uniform(-6, 8);
  posture.arms_out = random.uniform(-4, 7);
  posture.elbows = random.uniform(-5, 12);
  posture.shoulders_forward = random.uniform(-4, 4);
  return posture;
}

Matrix3d root_rotation(double yaw, double pitch, double roll) {
  return rotation_zyx(0, yaw, 0) * rotation_zyx(pitch, 0, 0) * rotation_zyx(0, 0, roll);
}

PoseMatrix pose_body(const TrackMatrix& tracks, double frame_rate, const Proportions& body,
                     const Posture& posture) {
  PoseMatrix poses = PoseMatrix::Zero(tracks.rows(), pose_columns);
  const Eigen::VectorXd sink = sinking(tracks, frame_rate, body);
  for (long i = 0; i < tracks.rows(); ++i) {
    const Vector3d root = root_place(tracks, i, body) - Vector3d(0, sink[i], 0);
    poses.row(i).segment<6>(root_x) << root.transpose(), tracks(i, pelvis_yaw),
        tracks(i, pelvis_pitch), tracks(i, pelvis_roll);
    const Matrix3d pelvis =
        root_rotation(tracks(i, pelvis_yaw), tracks(i, pelvis_pitch), tracks(i, pelvis_roll));
    for (const Side side : {Side::left, Side::right}) {
      pose_leg(tracks, i, side, pelvis, root, body, poses);
      pose_arm(tracks, i, side, posture, poses);
    }
    pose_torso(tracks, i, frame_rate, posture, poses);
  }
  limit_angles(poses);
  return poses;
}

void keep_feet(const PoseMatrix& planned, const TrackMatrix& tracks, const Proportions& body,
               PoseMatrix& poses) {
  for (long i = 0; i < poses.rows(); ++i) {
    Vector3d shift = Vector3d::Zero();
    double weights = 0;
    for (const Side side : {Side::left, Side::right}) {
      const double weight = standing_weight(tracks, i, side);
      shift += weight * (foot_place(planned, i, side, body) - foot_place(poses, i, side, body));
      weights += weight;
    }
    poses.row(i).segment<3>(root_x) += shift.transpose() / weights;
  }
}

void limit_angles(PoseMatrix& poses) {
  for (int joint = 1; joint < joint_count; ++joint) {
    for (int axis = 0; axis < 3; ++axis) {
      const AngleLimits& limits = describe(joint).limits[static_cast<std::size_t>(axis)];
      auto column = poses.col(angle_column(joint) + axis);
      column = column.cwiseMax(limits.low).cwiseMin(limits.high);
    }
  }
}

}  // namespace reprise::synth
