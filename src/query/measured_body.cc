// Which bones of a skeleton are compared.
#include <algorithm>
#include <numeric>

#include "query/posture_track.h"
#include "store/digest.h"

namespace reprise {
namespace {

struct ReferenceBone {
  int parent;    ///< body joint at its near end, -1: the middle of the hips
  float length;  ///< mm, of a man of 1.75 m
};

constexpr int joint(BodyJoint joint) { return static_cast<int>(joint); }

/// In the order of BodyJoint.
constexpr std::array<ReferenceBone, plan_bones> reference_body = {{
    {-1, 90.0f},
    {-1, 90.0f},
    {joint(BodyJoint::hip_left), 420.0f},
    {joint(BodyJoint::hip_right), 420.0f},
    {joint(BodyJoint::knee_left), 410.0f},
    {joint(BodyJoint::knee_right), 410.0f},
    {joint(BodyJoint::ankle_left), 140.0f},
    {joint(BodyJoint::ankle_right), 140.0f},
    {-1, 220.0f},
    {joint(BodyJoint::chest), 280.0f},
    {joint(BodyJoint::neck), 130.0f},
    {joint(BodyJoint::neck), 180.0f},
    {joint(BodyJoint::neck), 180.0f},
    {joint(BodyJoint::shoulder_left), 290.0f},
    {joint(BodyJoint::shoulder_right), 290.0f},
    {joint(BodyJoint::elbow_left), 260.0f},
    {joint(BodyJoint::elbow_right), 260.0f},
}};

MeasuredBody common_body(const BodyMatch& match) {
  MeasuredBody body;
  body.joints = match.joints;
  body.left = match.of(BodyJoint::hip_left);
  body.right = match.of(BodyJoint::hip_right);
  for (std::size_t i = 0; i < plan_bones; ++i) {
    body.plan.parents[i] = static_cast<std::int8_t>(reference_body[i].parent);
    if (match.joints[i] < 0) continue;
    // A bone reaches over those above it that the skeleton lacks.
    float length = reference_body[i].length;
    for (int above = reference_body[i].parent;
         above >= 0 && match.joints[static_cast<std::size_t>(above)] < 0;
         above = reference_body[static_cast<std::size_t>(above)].parent) {
      length += reference_body[static_cast<std::size_t>(above)].length;
    }
    body.plan.lengths[i] = length;
  }
  return body;
}

/// The joint that the motion goes through: the first one that turns.
int root_joint(const Skeleton& skeleton) {
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (!skeleton.joints[j].rotation_order.empty()) return static_cast<int>(j);
  }
  return 0;
}

bool is_below(const Skeleton& skeleton, int joint, int root) {
  for (; joint >= 0; joint = skeleton.joints[static_cast<std::size_t>(joint)].parent) {
    if (joint == root) return true;
  }
  return false;
}

/// The longest bones under the root, in the order of the file.
std::vector<int> longest_bones(const Skeleton& skeleton, int root) {
  std::vector<int> joints;
  for (int j = 0; j < static_cast<int>(skeleton.joints.size()); ++j) {
    if (j != root && is_below(skeleton, j, root)) joints.push_back(j);
  }
  const auto length = [&](int j) {
    return skeleton.joints[static_cast<std::size_t>(j)].offset.norm();
  };
  std::ranges::stable_sort(joints, [&](int a, int b) { return length(a) > length(b); });
  joints.resize(std::min<std::size_t>(joints.size(), plan_bones));
  std::ranges::sort(joints);
  return joints;
}

MeasuredBody own_body(const Skeleton& skeleton) {
  MeasuredBody body;
  body.left = body.right = root_joint(skeleton);
  body.joints.fill(-1);
  body.plan.parents.fill(-1);
  const ShortDigest digest = shortened(digest_of(structure_bytes(skeleton)));
  for (const std::uint8_t byte : digest) body.plan.id = body.plan.id << 8 | byte;
  if (body.plan.id == 0) body.plan.id = 1;
  const std::vector<int> joints = longest_bones(skeleton, body.left);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    body.joints[i] = joints[i];
    const Joint& bone = skeleton.joints[static_cast<std::size_t>(joints[i])];
    double length = bone.offset.norm();
    for (int above = bone.parent; above >= 0;) {
      const auto chosen = std::ranges::find(joints, above);
      if (chosen != joints.end()) {
        body.plan.parents[i] = static_cast<std::int8_t>(chosen - joints.begin());
        break;
      }
      if (above == body.left) break;
      const Joint& between = skeleton.joints[static_cast<std::size_t>(above)];
      length += between.offset.norm();
      above = between.parent;
    }
    body.plan.lengths[i] = static_cast<float>(length * skeleton.millimetres_per_unit);
  }
  return body;
}

}  // namespace

MeasuredBody measured_body(const Skeleton& skeleton, const JointMap& map) {
  const BodyMatch match = match_body(skeleton, map);
  return match.is_body() ? common_body(match) : own_body(skeleton);
}

}  // namespace reprise
