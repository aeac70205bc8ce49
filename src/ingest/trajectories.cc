#include "ingest/trajectories.h"

#include <Eigen/Cholesky>
#include <cassert>
#include <cmath>

#include "ingest/joint_angles.h"
#include "model/angle_units.h"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::VectorXd;

Channel kind_of_channel(const Skeleton& skeleton, int channel) {
  for (const Joint& joint : skeleton.joints) {
    const int within = channel - joint.first_channel;
    if (within >= 0 && within < static_cast<int>(joint.channels.size())) {
      return joint.channels[within];
    }
  }
  assert(false && "no such channel");
  return Channel::length;
}

/// Millimetres of all points together for one unit of the file, of each direct channel.
std::vector<double> direct_scale(const MarkerLayout& layout, const Skeleton& skeleton) {
  std::vector<double> scale;
  for (std::size_t d = 0; d < layout.direct_channels.size(); ++d) {
    const Channel kind = kind_of_channel(skeleton, layout.direct_channels[d]);
    scale.push_back(layout.direct_weight[d] *
                    (is_rotation(kind) ? radians_per_degree : skeleton.millimetres_per_unit));
  }
  return scale;
}

/// The same angles without jumps of whole turns.
VectorXd without_turns(VectorXd degrees) {
  for (Index f = 1; f < degrees.size(); ++f) {
    degrees[f] += 360.0 * std::round((degrees[f - 1] - degrees[f]) / 360.0);
  }
  return degrees;
}

/// A coefficient has the unit of a marker; root and direct columns are scaled to the same effect.
double quaternion_weight(const MarkerLayout& layout) {
  // A rotation by a small angle moves the unit quaternion by half of it.
  return 2.0 * layout.heading_weight_mm;
}

/// Stored axes are rounded, so no longer quite orthonormal: the coefficients that fit best are not
/// the projections on them.
Eigen::MatrixXd analysis_axes(const Eigen::MatrixXd& axes) {
  if (axes.cols() == 0) return axes;
  return axes * (axes.transpose() * axes)
                    .ldlt()
                    .solve(Eigen::MatrixXd::Identity(axes.cols(), axes.cols()));
}

void read_track(const MarkerLayout& layout, const TrajectoryMatrix& trajectories,
                RootTrack& track) {
  const Index frames = trajectories.rows();
  track.place = trajectories.leftCols(3) / std::sqrt(layout.point_count);
  if (track.tumbles) {
    track.orientation.resize(frames, 4);
    track.orientation = trajectories.middleCols(3, 4) / quaternion_weight(layout);
  } else {
    track.heading = trajectories.col(3) / layout.heading_weight_mm;
  }
}

}  // namespace

TrajectoryKinds trajectory_kinds(const CoefficientSpace& space, bool tumbles) {
  return {static_cast<int>(space.axes.cols()), space.layout.root_aligned ? (tumbles ? 7 : 4) : 0,
          static_cast<int>(space.layout.direct_channels.size())};
}

MarkedTake mark_take(const MarkerLayout& layout, const Take& take) {
  AlignedRoot root = align_root(layout, take);
  MarkedTake marked{MarkerMatrix(take.frames(), layout.dimensions()), std::move(root.track)};
  const auto channels = static_cast<std::size_t>(take.skeleton->channel_count);
  for (long f = 0; f < take.frames(); ++f) {
    place_markers(layout, {take.channels.row(f).data(), channels}, root.aligned[f],
                  {marked.markers.row(f).data(), static_cast<std::size_t>(layout.dimensions())});
  }
  return marked;
}

std::vector<double> resting_channels(const CoefficientSpace& space, const Skeleton& skeleton) {
  std::vector<double> resting = space.start;
  for (const Joint& joint : skeleton.joints) {
    for (std::size_t c = 0; c < joint.channels.size(); ++c) {
      if (skeleton.format == MotionFormat::bvh && is_position(joint.channels[c])) {
        resting[joint.first_channel + c] = joint.offset[axis_of(joint.channels[c])];
      }
    }
  }
  return resting;
}

TrajectoryMatrix to_trajectories(const CoefficientSpace& space, const Take& take,
                                 const MarkedTake& marked, const ChannelConstants& constants) {
  const MarkerLayout& layout = space.layout;
  const TrajectoryKinds kinds = trajectory_kinds(space, marked.root.tumbles);
  TrajectoryMatrix result(take.frames(), kinds.count());
  if (kinds.root > 0) {
    result.leftCols(3) = marked.root.place * std::sqrt(layout.point_count);
    if (marked.root.tumbles) {
      result.middleCols(3, 4) = marked.root.orientation * quaternion_weight(layout);
    } else {
      result.col(3) = marked.root.heading * layout.heading_weight_mm;
    }
  }
  result.middleCols(kinds.root, kinds.coefficients).noalias() =
      (marked.markers.rowwise() - space.mean.transpose()) * analysis_axes(space.axes);
  const int first_direct = kinds.root + kinds.coefficients;
  const std::vector<double> resting = resting_channels(space, *take.skeleton);
  const std::vector<double> scale = direct_scale(layout, *take.skeleton);
  for (int d = 0; d < kinds.direct; ++d) {
    const int channel = layout.direct_channels[d];
    if (!constants.empty() && constants[static_cast<std::size_t>(channel)]) {
      result.col(first_direct + d).setZero();
      continue;
    }
    VectorXd values = take.channels.col(channel);
    if (is_rotation(kind_of_channel(*take.skeleton, channel))) values = without_turns(values);
    result.col(first_direct + d) = (values.array() - resting[channel]) * scale[d];
  }
  return result;
}

ChannelMatrix to_channels(const CoefficientSpace& space, const Skeleton& skeleton, bool tumbles,
                          const TrajectoryMatrix& trajectories,
                          const std::vector<BranchSwitch>& switches,
                          const ChannelConstants& constants) {
  const MarkerLayout& layout = space.layout;
  const TrajectoryKinds kinds = trajectory_kinds(space, tumbles);
  const Index frames = trajectories.rows();
  const std::vector<double> resting = resting_channels(space, skeleton);
  const std::vector<double> scale = direct_scale(layout, skeleton);
  ChannelMatrix channels =
      Eigen::Map<const Eigen::RowVectorXd>(resting.data(), static_cast<Index>(resting.size()))
          .replicate(frames, 1);
  const int first_direct = kinds.root + kinds.coefficients;
  for (int d = 0; d < kinds.direct; ++d) {
    channels.col(layout.direct_channels[d]).array() +=
        trajectories.col(first_direct + d).array() / scale[d];
  }
  set_constants(constants, channels);
  RootTrack track;
  track.tumbles = tumbles;
  if (kinds.root > 0) read_track(layout, trajectories, track);

  MarkerMatrix markers =
      trajectories.middleCols(kinds.root, kinds.coefficients) * space.axes.transpose();
  markers.rowwise() += space.mean.transpose();
  JointAngleSolver solver(layout, space.start, constants);
  std::array<double, 3> root_angles{};
  const auto root_rotations = rotation_channels(skeleton.joints[layout.choices.root_joint]);
  for (std::size_t k = 0; k < std::min<std::size_t>(3, root_rotations.size()); ++k) {
    root_angles[k] = space.start[root_rotations[k].channel] * radians_per_degree;
  }
  const Matrix3d upright = Matrix3d::Identity();
  auto next_switch = switches.begin();
  for (Index f = 0; f < frames; ++f) {
    for (; next_switch != switches.end() && next_switch->frame == f; ++next_switch) {
      std::array<double, 3> degrees{};
      for (int k = 0; k < 3; ++k) degrees[k] = 90.0 * next_switch->quarter_turns[k];
      if (next_switch->driven < 0) {
        for (int k = 0; k < 3; ++k) root_angles[k] = degrees[k] * radians_per_degree;
      } else {
        solver.look_near(static_cast<std::size_t>(next_switch->driven), degrees);
      }
    }
    const std::span<double> row{channels.row(f).data(), std::size_t(skeleton.channel_count)};
    const Matrix3d aligned =
        solver.solve({markers.row(f).data(), static_cast<std::size_t>(layout.dimensions())},
                     tumbles || !layout.root_aligned ? &upright : nullptr, row);
    if (kinds.root > 0) {
      write_root_channels(layout, skeleton, track.place.row(f).transpose(),
                          world_orientation(track, f, aligned), row, root_angles);
    }
  }
  set_constants(constants, channels);
  return channels;
}

}  // namespace reprise
