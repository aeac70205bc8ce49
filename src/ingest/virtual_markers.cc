#include "ingest/virtual_markers.h"

#include <cassert>

#include "reprise/model/kinematics.h"

namespace reprise {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void place_markers(const MarkerLayout& layout, std::span<const double> channels,
                   const Matrix3d& root, std::span<double> markers) {
  assert(static_cast<int>(markers.size()) == layout.dimensions());
  const auto& joints = layout.reference.joints;
  const bool asf = layout.reference.format == MotionFormat::asf_amc;
  std::vector<JointFrame> frames(joints.size(), {Matrix3d::Identity(), Vector3d::Zero()});
  const auto root_joint = static_cast<std::size_t>(layout.choices.root_joint);
  for (std::size_t j = root_joint; j < joints.size(); ++j) {
    if (!layout.under_root[j]) continue;
    if (j == root_joint) {
      frames[j].rotation = root;
      continue;
    }
    const JointFrame& parent = frames[joints[j].parent];
    frames[j].rotation = parent.rotation * (joints[j].axis * local_rotation(joints[j], channels) *
                                            joints[j].axis.transpose());
    frames[j].position =
        parent.position + (asf ? frames[j].rotation : parent.rotation) * layout.offsets[j];
  }
  for (std::size_t m = 0; m < layout.markers.size(); ++m) {
    const Marker& marker = layout.markers[m];
    Eigen::Map<Vector3d> place(markers.data() + 3 * m);
    place = marker.off_bone ? Vector3d(frames[marker.joint].rotation * marker.local)
                            : frames[marker.joint].position;
  }
}

}  // namespace reprise
