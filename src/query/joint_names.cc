#include "query/joint_names.h"

#include <algorithm>
#include <array>

namespace reprise {
namespace {

using Words = std::span<const std::string_view>;
using namespace std::string_view_literals;

// BVH: names of Biped, Character Studio, HumanIK and MotionBuilder, Mixamo, Character Creator,
// Rigify and CMU's conversions.
constexpr std::array bvh_hip = {"upleg"sv, "upperleg"sv, "thigh"sv, "hipjoint"sv,
                                "hip"sv,   "femur"sv,    "uplegx"sv};
constexpr std::array bvh_knee = {"lowerleg"sv, "lowleg"sv, "calf"sv, "shin"sv,
                                 "knee"sv,     "leg"sv,    "tibia"sv};
constexpr std::array bvh_ankle = {"ankle"sv, "foot"sv};
constexpr std::array bvh_toe = {"toebase"sv, "toes"sv, "toe"sv, "toe0"sv, "ball"sv};
constexpr std::array bvh_chest = {"spine1"sv,  "spine01"sv, "chest"sv, "spine2"sv,
                                  "spine02"sv, "spine"sv,   "torso"sv};
constexpr std::array bvh_neck = {"neck"sv, "necktwist01"sv, "lowerneck"sv, "neck1"sv, "neck01"sv};
constexpr std::array bvh_head = {"head"sv};
constexpr std::array bvh_shoulder = {"upperarm"sv, "uparm"sv, "arm"sv, "humerus"sv, "shoulder"sv};
constexpr std::array bvh_elbow = {"forearm"sv, "lowerarm"sv, "lowarm"sv, "elbow"sv, "radius"sv};
constexpr std::array bvh_hand = {"wrist"sv, "hand"sv};

// ASF: bones, for the sake of their far ends.
constexpr std::array asf_hip = {"hipjoint"sv};
constexpr std::array asf_knee = {"femur"sv};
constexpr std::array asf_ankle = {"tibia"sv};
constexpr std::array asf_toe = {"foot"sv};
constexpr std::array asf_chest = {"upperback"sv, "lowerback"sv};
constexpr std::array asf_neck = {"thorax"sv};
constexpr std::array asf_head = {"upperneck"sv, "neck"sv, "lowerneck"sv, "head"sv};
constexpr std::array asf_shoulder = {"clavicle"sv};
constexpr std::array asf_elbow = {"humerus"sv};
constexpr std::array asf_hand = {"radius"sv, "wrist"sv, "hand"sv};

constexpr std::array<Words, 10> bvh_words = {bvh_hip,  bvh_knee, bvh_ankle,    bvh_toe,   bvh_chest,
                                             bvh_neck, bvh_head, bvh_shoulder, bvh_elbow, bvh_hand};
constexpr std::array<Words, 10> asf_words = {asf_hip,  asf_knee, asf_ankle,    asf_toe,   asf_chest,
                                             asf_neck, asf_head, asf_shoulder, asf_elbow, asf_hand};

/// What exporters put before every name.
constexpr std::array prefixes = {"ccbase"sv, "mixamorig"sv,  "bip001"sv,   "bip01"sv,
                                 "bip"sv,    "character1"sv, "skeleton"sv, "rl"sv};

enum class Side { left, right, none };

Side side_of(BodyJoint joint) {
  using enum BodyJoint;
  if (joint == chest || joint == neck || joint == head) return Side::none;
  const int number = static_cast<int>(joint);
  const bool first_of_pair = joint < chest ? number % 2 == 0 : number % 2 == 1;
  return first_of_pair ? Side::left : Side::right;
}

/// Index into the tables of words.
std::size_t kind_of(BodyJoint joint) {
  const int number = static_cast<int>(joint);
  constexpr int chest = static_cast<int>(BodyJoint::chest);
  constexpr int shoulders = static_cast<int>(BodyJoint::shoulder_left);
  if (number < chest) return static_cast<std::size_t>(number / 2);
  if (number < shoulders) return static_cast<std::size_t>(number - chest + 4);
  return static_cast<std::size_t>((number - shoulders) / 2 + 7);
}

bool is_joined(std::string_view name, std::string_view a, std::string_view b) {
  return name.size() == a.size() + b.size() && name.starts_with(a) && name.ends_with(b);
}

}  // namespace

std::span<const std::string_view> words_for(BodyJoint joint, MotionFormat format) {
  return (format == MotionFormat::bvh ? bvh_words : asf_words)[kind_of(joint)];
}

std::string plain_name(std::string_view name) {
  const std::size_t space = name.find_last_of(":|");
  if (space != std::string_view::npos) name.remove_prefix(space + 1);
  std::string plain;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') {
      plain += static_cast<char>(c - 'A' + 'a');
    } else if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) {
      plain += c;
    }
  }
  for (const std::string_view prefix : prefixes) {
    if (plain.size() > prefix.size() && plain.starts_with(prefix)) {
      return plain.substr(prefix.size());
    }
  }
  return plain;
}

bool is_called(std::string_view plain_name, BodyJoint joint, std::string_view word) {
  const Side side = side_of(joint);
  if (side == Side::none) return plain_name == word;
  const bool left = side == Side::left;
  const std::string_view full = left ? "left" : "right";
  const std::string_view letter = left ? "l" : "r";
  return is_joined(plain_name, full, word) || is_joined(plain_name, letter, word) ||
         is_joined(plain_name, word, full) || is_joined(plain_name, word, letter);
}

}  // namespace reprise
