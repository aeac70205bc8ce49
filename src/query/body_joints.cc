#include "reprise/query/body_joints.h"

#include <algorithm>
#include <fstream>

#include "query/body_hierarchy.h"
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

constexpr std::array<std::string_view, 4> source_names = {"none", "name", "hierarchy", "map"};

/// Places of a left and a right joint are apart by at least this part of the body.
constexpr double least_apart = 1e-4;

/// The same joint on the other side; the joint itself in the middle.
std::size_t other_side(std::size_t joint) {
  const std::string_view name = names[joint];
  for (const auto& [side, other] : {std::pair("_left", "_right"), std::pair("_right", "_left")}) {
    if (!name.ends_with(side)) continue;
    const std::string found =
        std::string(name.substr(0, name.size() - std::string_view(side).size())) + other;
    return static_cast<std::size_t>(std::ranges::find(names, found) - names.begin());
  }
  return joint;
}

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

/// The joint between two others that halves the way best, by the lengths of bones; -1 without
/// these, or between them.
int middle_between(const Skeleton& skeleton, int upper, int lower) {
  if (upper < 0 || lower < 0) return -1;
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

/// Where nothing was found before.
void fill(BodyMatch& match, BodyJoint joint, int index) {
  if (index < 0 || slot(match, joint) >= 0) return;
  slot(match, joint) = index;
  match.sources[static_cast<std::size_t>(joint)] = BodySource::hierarchy;
}

void fill_between(const Skeleton& skeleton, BodyMatch& match, BodyJoint upper, BodyJoint middle,
                  BodyJoint lower) {
  if (match.of(middle) >= 0 || match.of(upper) < 0 || match.of(lower) < 0) return;
  fill(match, middle, middle_between(skeleton, match.of(upper), match.of(lower)));
}

/// The joint that two joints hang from, or one of them where it is above the other.
int common_joint(const Skeleton& skeleton, int a, int b) {
  const auto parent = [&](int j) { return skeleton.joints[static_cast<std::size_t>(j)].parent; };
  while (a != b && a >= 0 && b >= 0) (a > b ? a : b) = parent(a > b ? a : b);
  return a == b ? a : -1;
}

/// The spine may lead up from the hips or, below a head that is the root, down to them.
void fill_chest(const Skeleton& skeleton, BodyMatch& match) {
  if (match.of(chest) >= 0 || match.of(neck) < 0) return;
  const int hips =
      match.of(hip_left) < 0 ? 0 : common_joint(skeleton, match.of(hip_left), match.of(neck));
  if (hips == match.of(neck)) {
    fill(match, chest, middle_between(skeleton, hips, match.of(hip_left)));
  } else if (hips >= 0) {
    fill(match, chest, middle_between(skeleton, hips, match.of(neck)));
  }
}

/// True if the joint is the one that the legs hang from, or above it.
bool carries_legs(const Skeleton& skeleton, const BodyMatch& match, int joint) {
  const int left = match.of(hip_left), right = match.of(hip_right);
  if (left < 0 || right < 0) return false;
  return common_joint(skeleton, common_joint(skeleton, left, right), joint) == joint;
}

/// Whether one has on the left what the other has on the right.
bool sides_differ(const BodyMatch& a, const BodyMatch& b) {
  for (std::size_t i = 0; i < body_joint_count; ++i) {
    const std::size_t other = other_side(i);
    if (other != i && a.joints[i] >= 0 && a.joints[i] == b.joints[other]) return true;
  }
  return false;
}

void swap_sides(BodyMatch& match) {
  for (std::size_t i = 0; i < body_joint_count; ++i) {
    if (other_side(i) > i) std::swap(match.joints[i], match.joints[other_side(i)]);
  }
}

/// What names leave open, by the hierarchy.
void fill_by_hierarchy(const Skeleton& skeleton, BodyMatch& match) {
  fill_between(skeleton, match, hip_left, knee_left, ankle_left);
  fill_between(skeleton, match, hip_right, knee_right, ankle_right);
  fill_between(skeleton, match, shoulder_left, elbow_left, hand_left);
  fill_between(skeleton, match, shoulder_right, elbow_right, hand_right);
  if (match.of(head) >= 0) {
    fill(match, neck, skeleton.joints[static_cast<std::size_t>(match.of(head))].parent);
  }
  fill_chest(skeleton, match);
}

/// The next joint on the way from a joint down to `lower` that is in another place, else -1.
int next_apart(const Skeleton& skeleton, const PositionMatrix& rest, int from, int lower) {
  if (lower < 0) return -1;
  std::vector<int> way = joints_between(skeleton, from, lower);
  std::reverse(way.begin(), way.end());
  for (const int j : way) {
    const double moved = (rest.block<1, 3>(0, 3 * j) - rest.block<1, 3>(0, 3 * from)).norm();
    if (moved > 0) return j;
  }
  return -1;
}

/// Joints that only begin a limb lie in one place: the hip, or the shoulder, is the next one.
void part_pair(const Skeleton& skeleton, const PositionMatrix& rest, BodyMatch& match,
               BodyJoint left, BodyJoint right, BodyJoint below_left, BodyJoint below_right) {
  const int a = match.of(left), b = match.of(right);
  if (a < 0 || b < 0) return;
  const double size = (rest.rowwise().maxCoeff() - rest.rowwise().minCoeff()).norm();
  const double apart = (rest.block<1, 3>(0, 3 * a) - rest.block<1, 3>(0, 3 * b)).norm();
  if (apart > least_apart * size) return;
  for (const auto& [joint, below] : {std::pair(left, below_left), std::pair(right, below_right)}) {
    if (match.sources[static_cast<std::size_t>(joint)] == BodySource::map) continue;
    slot(match, joint) = next_apart(skeleton, rest, match.of(joint), match.of(below));
    match.sources[static_cast<std::size_t>(joint)] =
        match.of(joint) < 0 ? BodySource::none : BodySource::hierarchy;
  }
}

/// Whether the rest pose says where joints are: in some files only the motion does.
bool has_places(const PositionMatrix& rest) {
  return rest.size() > 0 && (rest.rowwise().maxCoeff() - rest.rowwise().minCoeff()).norm() > 0;
}

/// What names leave open of a body that stands there without them.
void fill_from_rest_pose(const Skeleton& skeleton, BodyMatch& match) {
  std::optional<BodyMatch> standing = body_by_hierarchy(skeleton);
  if (!standing) return;
  if (sides_differ(match, *standing)) swap_sides(*standing);
  for (std::size_t i = 0; i < body_joint_count; ++i) {
    fill(match, static_cast<BodyJoint>(i), standing->joints[i]);
  }
}

/// What a name alone does not tell: a toe that is called foot, below the ankle, and a torso that
/// the legs hang from, too.
void correct_names(const Skeleton& skeleton, const std::vector<std::string>& plain,
                   BodyMatch& match) {
  for (const auto& [toe, ankle] :
       {std::pair(toe_left, ankle_left), std::pair(toe_right, ankle_right)}) {
    for (std::size_t j = 0; j < plain.size() && match.of(toe) < 0 && match.of(ankle) >= 0; ++j) {
      const int foot = static_cast<int>(j);
      if (foot == match.of(ankle) || !is_called(plain[j], toe, "foot")) continue;
      if (common_joint(skeleton, foot, match.of(ankle)) != match.of(ankle)) continue;
      slot(match, toe) = foot;
      match.sources[static_cast<std::size_t>(toe)] = BodySource::name;
    }
  }
  const std::size_t torso = static_cast<std::size_t>(chest);
  if (match.sources[torso] == BodySource::name &&
      carries_legs(skeleton, match, match.joints[torso])) {
    match.joints[torso] = -1;
    match.sources[torso] = BodySource::none;
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

std::string_view body_source_name(BodySource source) {
  return source_names[static_cast<std::size_t>(source)];
}

BodyMatch match_body(const Skeleton& skeleton, const JointMap& map) {
  const std::vector<std::string> plain = plain_names(skeleton);
  BodyMatch match;
  for (std::size_t i = 0; i < body_joint_count; ++i) {
    const auto joint = static_cast<BodyJoint>(i);
    match.joints[i] = find_by_name(skeleton, plain, joint);
    match.sources[i] = match.joints[i] < 0 ? BodySource::none : BodySource::name;
    const auto corrected = map.find(joint);
    if (corrected == map.end()) continue;
    const auto named = std::ranges::find(skeleton.joints, corrected->second, &Joint::name);
    if (named != skeleton.joints.end() && !named->end_site) {
      match.joints[i] = static_cast<int>(named - skeleton.joints.begin());
      match.sources[i] = BodySource::map;
    }
  }
  correct_names(skeleton, plain, match);
  fill_by_hierarchy(skeleton, match);
  const PositionMatrix rest = rest_positions(skeleton);
  if (has_places(rest)) {
    part_pair(skeleton, rest, match, hip_left, hip_right, knee_left, knee_right);
    part_pair(skeleton, rest, match, shoulder_left, shoulder_right, elbow_left, elbow_right);
  }
  if (!match.is_body()) {
    fill_from_rest_pose(skeleton, match);
    fill_by_hierarchy(skeleton, match);
  }
  for (const auto& [joint, name] : map) {
    if (!name.empty()) continue;
    slot(match, joint) = -1;
    match.sources[static_cast<std::size_t>(joint)] = BodySource::map;
  }
  return match;
}

}  // namespace reprise
