// A take as trajectories in one unit, so that one quantisation step serves all of them, and back.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "ingest/marker_layout.h"
#include "ingest/root_alignment.h"
#include "ingest/virtual_markers.h"
#include "model/constant_channels.h"
#include "reprise/model/take.h"

namespace reprise {

/// Of each channel, the values that takes of a skeleton often have where they do not move, the
/// commonest first; at most `KnownValueLimits::values`.
using KnownValues = std::vector<std::vector<double>>;
struct KnownValueLimits {
  static constexpr std::size_t values = 7;
};

/// A mean posture and the axes on which postures are written (lin-2011 section 4).
struct CoefficientSpace {
  MarkerLayout layout;
  Eigen::VectorXd mean;                  ///< 3*markers, mm
  std::vector<std::int32_t> mean_steps;  ///< the same in whole steps, as it is stored
  Eigen::MatrixXd axes;                  ///< 3*markers x axes, near orthonormal
  Eigen::VectorXd variance;              ///< of each axis over the takes that made it, mm^2
  std::vector<double>
      start;  ///< a whole frame (degrees and units): what channels are where nothing else says so
  KnownValues known;  ///< what channels often are where they do not move
};

/// frames x trajectories: the root's track, then coefficients of the axes, then the direct
/// channels. A unit is a millimetre of the root of the summed squares of all points: an error of e
/// in any trajectory adds e^2 to the summed squared error of a frame's points.
using TrajectoryMatrix = Eigen::MatrixXd;

/// Which column is what.
struct TrajectoryKinds {
  int coefficients = 0;
  int root = 0;  ///< 0, 4 (place, heading) or 7 (place, quaternion)
  int direct = 0;
  int count() const { return coefficients + root + direct; }
};
TrajectoryKinds trajectory_kinds(const CoefficientSpace& space, bool tumbles);

/// Markers of every frame, and the root's track on the way.
struct MarkedTake {
  MarkerMatrix markers;
  RootTrack root;
};
MarkedTake mark_take(const MarkerLayout& layout, const Take& take);

/// Where a direct channel is without its trajectory: the offset of a position channel, else the
/// space's start.
std::vector<double> resting_channels(const CoefficientSpace& space, const Skeleton& skeleton);

/// Channels of `constants` (one a channel, or none at all) take no trajectory.
TrajectoryMatrix to_trajectories(const CoefficientSpace& space, const Take& take,
                                 const MarkedTake& marked, const ChannelConstants& constants = {});

/// A place where the angles of a joint are written in another way than continuity says: in frame
/// `frame` the solver looks near `degrees` for driven joint `driven` (or the root joint, where
/// driven is -1).
struct BranchSwitch {
  std::int32_t frame = 0;
  std::int32_t driven = 0;
  std::array<std::int32_t, 3> quarter_turns{};  ///< each angle to look near, in units of 90 degrees
};

/// The way back: channels of every frame, on the skeleton of the take. Those of `constants` (one a
/// channel, or none at all) are as it says.
ChannelMatrix to_channels(const CoefficientSpace& space, const Skeleton& skeleton, bool tumbles,
                          const TrajectoryMatrix& trajectories,
                          const std::vector<BranchSwitch>& switches,
                          const ChannelConstants& constants = {});

/// The switches that keep decoded angles in the source's own branch.
std::vector<BranchSwitch> find_branch_switches(const CoefficientSpace& space, const Take& source,
                                               const ChannelMatrix& decoded);

}  // namespace reprise
