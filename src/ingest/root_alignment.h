// Takes the place and the heading of a motion out of it (lin-2011 section 3).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>

#include "ingest/marker_layout.h"
#include "reprise/model/kinematics.h"
#include "reprise/model/take.h"

namespace reprise {

struct AlignmentConstants {
  /// A root that tilts further than this from upright in some frame (cosine of half the tilt) has
  /// all six degrees of freedom taken out: near 180 degrees of tilt a heading means nothing.
  static constexpr double least_upright_cosine = 0.64;  // tilts beyond 100 degrees
};

/// The motion of the root joint through the world, which is turned so that Y points up.
struct RootTrack {
  bool tumbles = false;                            ///< all six degrees of freedom are taken out
  Eigen::Matrix<double, Eigen::Dynamic, 3> place;  ///< frames x 3, mm
  Eigen::VectorXd heading;  ///< frames, radians, without jumps; empty if it tumbles
  Eigen::Matrix<double, Eigen::Dynamic, 4>
      orientation;  ///< frames x (x, y, z, w), signs continuous; if it tumbles
};

/// Turns the root joint's upward axis (LayoutChoices) to Y, so that an upright body is upright
/// whatever its axes are.
Eigen::Matrix3d home_orientation(int up_axis);

/// What brings the orientation of a root joint that faces ahead, in a world that is turned so that
/// Y points up (turn_to_y), to one without a heading. The root's axes are turned with the world's,
/// as exporters do it: `up_axis` is the same for a body written with another axis up.
Eigen::Matrix3d from_home_orientation(int up_axis, UpAxis world_up);

/// Rotation about the vertical (Y) that is in `rotation`: the twist of its swing-twist
/// decomposition.
double heading_of(const Eigen::Matrix3d& rotation);

/// The root's track, and the aligned orientation of the root joint in each frame.
struct AlignedRoot {
  RootTrack track;
  std::vector<Eigen::Matrix3d> aligned;  ///< identity where the root tumbles or is not aligned
};
AlignedRoot align_root(const MarkerLayout& layout, const Take& take);

/// The world orientation of the root joint of one frame, Y up, from the track and the aligned
/// orientation.
Eigen::Matrix3d world_orientation(const RootTrack& track, long frame,
                                  const Eigen::Matrix3d& aligned);

/// Writes the channels of the root joint so that it is at `place_y_up` (mm) with orientation
/// `world_y_up`, once the world is turned back so that the skeleton's own axis points up.
/// The channels of the joints above it are there already; `previous` are the root's angles of the
/// frame before (radians, outermost first), which are brought up to date.
void write_root_channels(const MarkerLayout& layout, const Skeleton& skeleton,
                         const Eigen::Vector3d& place_y_up, const Eigen::Matrix3d& world_y_up,
                         std::span<double> channels, std::array<double, 3>& previous);

}  // namespace reprise
