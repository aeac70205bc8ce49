// Virtual markers back to joint angles, with bone lengths exactly those of the skeleton.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "ingest/marker_layout.h"
#include "model/constant_channels.h"

namespace reprise {

/// Solves frame after frame; each frame continues the angles of the one before, so that what comes
/// out is continuous and may run past 180 degrees.
class JointAngleSolver {
 public:
  /// `start` is a whole frame of channels (degrees): where the angles of the first frame are looked
  /// for. Angles of `constants` (one a channel, or none at all) stay as they are there.
  JointAngleSolver(const MarkerLayout& layout, std::span<const double> start,
                   const ChannelConstants& constants = {});

  /// Makes the next frame look for the angles of driven joint `index` near these (degrees,
  /// outermost first; of a longer chain the first ones).
  void look_near(std::size_t index, std::span<const double> degrees);

  /// `markers` has layout.dimensions() numbers; the direct channels are read from `channels`.
  /// Writes the channels of the driven joints into `channels` (degrees) and returns the aligned
  /// orientation of the root joint. With `known_root` the root is not solved for but as given.
  Eigen::Matrix3d solve(std::span<const double> markers, const Eigen::Matrix3d* known_root,
                        std::span<double> channels);

 private:
  /// Where the targets of a driven joint are seen while it is not turned.
  struct TargetsAtRest {
    std::vector<Eigen::Vector3d> directions;
    Eigen::Matrix3d to_basis =
        Eigen::Matrix3d::Identity();  ///< of a target on and one off the bone
  };

  Eigen::Matrix3d solve_joint(std::size_t index, std::span<const double> markers,
                              const Eigen::Matrix3d& parent, const Eigen::Vector3d& centre,
                              std::span<double> channels);
  Eigen::Matrix3d seen_rotation(std::size_t index, std::span<const double> markers,
                                const Eigen::Matrix3d& to_local,
                                const Eigen::Vector3d& centre) const;

  const MarkerLayout& layout_;
  std::vector<std::vector<RotationChannel>> rotation_channels_;  ///< of each driven joint
  std::vector<double> angles_;  ///< of the last frame, a number a channel, radians
  std::vector<Eigen::Matrix3d> rotations_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<int> driven_of_joint_;
  std::vector<TargetsAtRest> at_rest_;  ///< a driven joint each
};

}  // namespace reprise
