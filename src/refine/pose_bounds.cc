#include "refine/pose_bounds.h"

namespace reprise {
namespace {

using Eigen::Matrix3d;

/// Squared chord of a joint's turn against its parent from frame f - 1 to f.
double local_step(const Skeleton& skeleton, const PoseTrack& track, std::size_t joint,
                  std::size_t f) {
  const int parent = skeleton.joints[joint].parent;
  const Matrix3d &before = track[joint][f - 1].rotation, &now = track[joint][f].rotation;
  if (parent < 0) return squared_chord(before, now);
  const std::vector<JointFrame>& above = track[static_cast<std::size_t>(parent)];
  return squared_chord(above[f - 1].rotation.transpose() * before,
                       above[f].rotation.transpose() * now);
}

}  // namespace

PoseTrack pose_track(const Skeleton& skeleton, const ChannelMatrix& channels) {
  PoseTrack track(skeleton.joints.size());
  for (auto& frames : track) frames.resize(static_cast<std::size_t>(channels.rows()));
  std::vector<JointFrame> joints(skeleton.joints.size());
  for (Eigen::Index f = 0; f < channels.rows(); ++f) {
    forward_kinematics(skeleton,
                       {channels.row(f).data(), static_cast<std::size_t>(channels.cols())}, joints);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      track[j][static_cast<std::size_t>(f)] = joints[j];
    }
  }
  return track;
}

PositionMatrix positions_of(const PoseTrack& track) {
  const std::size_t frames = track.empty() ? 0 : track.front().size();
  PositionMatrix result(static_cast<Eigen::Index>(frames),
                        3 * static_cast<Eigen::Index>(track.size()));
  for (std::size_t j = 0; j < track.size(); ++j) {
    for (std::size_t f = 0; f < frames; ++f) {
      result.row(static_cast<Eigen::Index>(f)).segment<3>(3 * static_cast<Eigen::Index>(j)) =
          track[j][f].position.transpose();
    }
  }
  return result;
}

double PoseBounds::pop_degrees(const Skeleton& skeleton, const PoseTrack& source,
                               const PoseTrack& decoded, std::size_t joint, std::size_t f) const {
  const double step = local_step(skeleton, decoded, joint, f);
  // Most steps are so small that the source's need not be looked at.
  if (step <= squared_chord_) return 0;
  return degrees_of_chord(step) - degrees_of_chord(local_step(skeleton, source, joint, f));
}

}  // namespace reprise
