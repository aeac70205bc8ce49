// A bone of an ASF, and the joint that it makes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reprise/model/skeleton.h"

namespace reprise {

/// A bone as its lines in `:bonedata` give it, or the root as `:root` does, in the file's units.
struct AsfBone {
  std::string name;
  /// Unit vector along the bone; of the root: its `position`, a length.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  double length = 1;
  /// The angles of its own axes about x, y and z, whatever their order; of the root: `orientation`.
  Eigen::Vector3d axis_angles = Eigen::Vector3d::Zero();
  std::vector<int> axis_order = {0, 1, 2};  ///< the first turns first
  std::vector<Channel> degrees_of_freedom;
};

/// The joint at a bone's far end (Joint), still without parent and first channel. Angles of axes
/// are in radians or in degrees.
Joint joint_of(const AsfBone& bone, bool radians);

}  // namespace reprise
