#include "reprise/query/body_joints.h"

#include <algorithm>
#include <fstream>

#include "query/joint_names.h"
#include "reprise/error.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

using enum BodyJoint;

constexpr std::array<std::string_view, body_joint_count> names = {
    "hip_left",       "hip_right",  "knee_left",   "knee_right", "ankle_left", "ankle_right",
    "toe_left",       "toe_right",  "chest",       "neck",       "head",       "shoulder_left",
    "shoulder_right", "elbow_left", "elbow_right", "hand_left",  "hand_right"};

int find_by_name(const Skeleton& skeleton, const std::vector<std::string>& plain, BodyJoint joint) {
  for (const std::string_view word : words_for(joint, skeleton.format)) {
    for (std::size_t j = 0; j < plain.size(); ++j) {
      if (!skeleton.joints[j].end_site && is_called(plain[j], joint, word)) {
        return static_cast<int>(j);
      }
    }
  }
  return -1;
}

/// The joints strictly between one and a joint below it, from the lower one on; empty if it is not
/// below.
std::vector<int> joints_between(const Skeleton& skeleton, int upper, int lower) {
  std::vector<int> between;
  for (int j = skeleton.joints[static_cast<std::size_t>(lower)].parent; j >= 0;
       j = skeleton.joints[static_cast<std::size_t>(j)].parent) {
    if (j == upper) return between;
    between.push_back(j);
  }
  return {};
}

/// The joint between two others that halves the way best, by the lengths of bones.
int middle_between(const Skeleton& skeleton, int upper, int lower) {
  const std::vector<int> between = joints_between(skeleton, upper, lower);
  double total = skeleton.joints[static_cast<std::size_t>(lower)].offset.norm();
  for (const int j : between) total += skeleton.joints[static_cast<std::size_t>(j)].offset.norm();
  double way = skeleton.joints[static_cast<std::size_t>(lower)].offset.norm();
  int best = -1;
  double best_distance = total;
  for (const int j : between) {
    const double distance = std::abs(way - total / 2);
    if (best < 0 || distance < best_distance) {
      best = j;
      best_distance = distance;
    }
    way += skeleton.joints[static_cast<std::size_t>(j)].offset.norm();
  }
  return best;
}

int& slot(BodyMatch& match, BodyJoint joint) {
  return match.joints[static_cast<std::size_t>(joint)];
}

void fill_between(const Skeleton& skeleton, BodyMatch& match, BodyJoint upper, BodyJoint middle,
                  BodyJoint lower) {
  if (slot(match, middle) >= 0 || match.of(upper) < 0 || match.of(lower) < 0) return;
  slot(match, middle) = middle_between(skeleton, match.of(upper), match.of(lower));
}

/// What names leave open, by the hierarchy.
void fill_by_hierarchy(const Skeleton& skeleton, BodyMatch& match) {
  fill_between(skeleton, match, hip_left, knee_left, ankle_left);
  fill_between(skeleton, match, hip_right, knee_right, ankle_right);
  fill_between(skeleton, match, shoulder_left, elbow_left, hand_left);
  fill_between(skeleton, match, shoulder_right, elbow_right, hand_right);
  if (match.of(neck) < 0 && match.of(head) >= 0) {
    slot(match, neck) = skeleton.joints[static_cast<std::size_t>(match.of(head))].parent;
  }
  if (match.of(chest) < 0 && match.of(neck) >= 0) {
    slot(match, chest) = middle_between(skeleton, 0, match.of(neck));
  }
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

std::string_view body_joint_name(BodyJoint joint) { return names[static_cast<std::size_t>(joint)]; }

std::optional<BodyJoint> find_body_joint(std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<BodyJoint>(found - names.begin());
}

JointMap read_joint_map(const std::filesystem::path& path) {
  const std::string text = read_whole_file(path);
  JointMap map;
  std::size_t line_number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line(text.data() + at, end - at);
    at = end + 1;
    ++line_number;
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const std::size_t equals = line.find('=');
    const auto joint = find_body_joint(trimmed(line.substr(0, equals)));
    if (equals == std::string_view::npos || !joint) {
      throw Error(
          ErrorCode::rejected_input, "this is no line of a joint map", {path.string(), line_number},
          "write \"BODY JOINT = JOINT\"; reprise info ARCHIVE TAKE lists the body's joints");
    }
    map[*joint] = trimmed(line.substr(equals + 1));
  }
  return map;
}

bool BodyMatch::is_body() const {
  const auto has = [&](BodyJoint joint) { return of(joint) >= 0; };
  return has(hip_left) && has(hip_right) && has(knee_left) && has(knee_right) && has(ankle_left) &&
         has(ankle_right) && (has(neck) || has(head)) && (has(shoulder_left) || has(elbow_left)) &&
         (has(shoulder_right) || has(elbow_right)) && has(hand_left) && has(hand_right);
}

BodyMatch match_body(const Skeleton& skeleton, const JointMap& map) {
  std::vector<std::string> plain;
  for (const Joint& joint : skeleton.joints) plain.push_back(plain_name(joint.name));
  BodyMatch match;
  for (std::size_t i = 0; i < body_joint_count; ++i) {
    const auto joint = static_cast<BodyJoint>(i);
    match.joints[i] = find_by_name(skeleton, plain, joint);
    const auto corrected = map.find(joint);
    if (corrected == map.end()) continue;
    const auto named = std::ranges::find(skeleton.joints, corrected->second, &Joint::name);
    if (named != skeleton.joints.end() && !named->end_site) {
      match.joints[i] = static_cast<int>(named - skeleton.joints.begin());
    }
  }
  fill_by_hierarchy(skeleton, match);
  for (const auto& [joint, name] : map) {
    if (name.empty()) slot(match, joint) = -1;
  }
  return match;
}

}  // namespace reprise
