// From tracks to joint angles of one body: legs by inverse kinematics, so that feet stay where they
// are put.
#pragma once

#include "synth/performance.h"

namespace reprise::synth {

/// Columns of a pose: the root's place (mm) and its heading, pitch and roll (degrees), then x, y, z
/// of each joint but the hips, in degrees.
enum PoseColumn : int { root_x, root_y, root_z, root_yaw, root_pitch, root_roll, first_angle };
constexpr int pose_columns = first_angle + 3 * (joint_count - 1);
constexpr int angle_column(int joint) { return first_angle + 3 * (joint - 1); }

/// frames x pose_columns.
using PoseMatrix = Eigen::Matrix<double, Eigen::Dynamic, pose_columns, Eigen::RowMajor>;

/// How someone holds the body: degrees that are added to the tracks.
struct Posture {
  double torso_pitch = 0;
  double head_pitch = 0;
  double arms_out = 0;
  double elbows = 0;
  double shoulders_forward = 0;
};

Posture random_posture(Random random);

/// Tracks in world directions, one row a frame. Angles stay within the joints' limits.
PoseMatrix pose_body(const TrackMatrix& tracks, double frame_rate, const Proportions& body,
                     const Posture& posture);

/// Root orientation from heading, pitch and roll: Ry Rx Rz.
Eigen::Matrix3d root_rotation(double yaw, double pitch, double roll);

/// Moves the root so that feet on the floor are in `poses` where they are in `planned`.
void keep_feet(const PoseMatrix& planned, const TrackMatrix& tracks, const Proportions& body,
               PoseMatrix& poses);

/// Brings every angle within its joint's limits.
void limit_angles(PoseMatrix& poses);

}  // namespace reprise::synth
