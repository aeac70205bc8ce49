// The joints that bodies of different skeletons have in common, and which joint of a skeleton each
// of them is.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "reprise/model/skeleton.h"

namespace reprise {

/// A parent comes before its children (see body_bones).
enum class BodyJoint : int {
  hip_left,
  hip_right,
  knee_left,
  knee_right,
  ankle_left,
  ankle_right,
  toe_left,
  toe_right,
  chest,
  neck,
  head,
  shoulder_left,
  shoulder_right,
  elbow_left,
  elbow_right,
  hand_left,
  hand_right
};
constexpr std::size_t body_joint_count = 17;

/// "hip_left": the enumerator's name.
std::string_view body_joint_name(BodyJoint joint);
std::optional<BodyJoint> find_body_joint(std::string_view name);

/// A user's corrections: names of joints of skeletons. An empty name says that there is none.
using JointMap = std::map<BodyJoint, std::string>;

/// Lines "body joint = joint of the skeleton", such as "hip_left = LThigh"; what follows a '#' and
/// empty lines are left aside. Throws Error (rejected_input) with file and line.
JointMap read_joint_map(const std::filesystem::path& path);

/// How a body joint was found. A user's entry that says that there is none counts as `map`.
enum class BodySource : int { none, name, hierarchy, map };
/// "none", "name", "hierarchy" or "map".
std::string_view body_source_name(BodySource source);

/// Of each body joint the index of the skeleton's joint whose place is meant, or -1.
struct BodyMatch {
  std::array<int, body_joint_count> joints;
  std::array<BodySource, body_joint_count> sources{};

  int of(BodyJoint joint) const { return joints[static_cast<std::size_t>(joint)]; }
  /// Hips, knees, ankles, a neck or head, shoulders or elbows, and hands are there: less is no body
  /// that could be compared.
  bool is_body() const;
};

/// Matches joints by their names (as BVH exporters and ASF files have them), and what names leave
/// open by where joints are in the hierarchy and the rest pose: a knee lies between hip and ankle;
/// a body has two equal legs, two equal arms above them and a head, and its feet say what is in
/// front. Entries of `map` that name a joint of the skeleton come first. A joint of an ASF stands
/// for the far end of its bone, so that `ltibia` is the ankle. Two joints in one place are never
/// taken for a left and a right one: the next joint below that is apart is meant.
BodyMatch match_body(const Skeleton& skeleton, const JointMap& map = {});

}  // namespace reprise
