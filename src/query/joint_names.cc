#include "query/joint_names.h"

#include <algorithm>
#include <array>
#include <map>

namespace reprise {
namespace {

using Words = std::span<const std::string_view>;
using namespace std::string_view_literals;

// BVH: names of Biped, Character Studio, HumanIK and MotionBuilder, Mixamo, Character Creator,
// Rigify, CMU's conversions, DeepMotion, VRoid, Axis Neuron, Second Life, Daz, Poser,
// MakeHuman and SMPL.
constexpr std::array bvh_hip = {"upleg"sv,     "upperleg"sv,  "thigh"sv,        "hipjoint"sv,
                                "hip"sv,       "femur"sv,     "uplegx"sv,       "legupper"sv,
                                "uplegroll"sv, "thighbend"sv, "thighstretch"sv, "upperleg01"sv};
constexpr std::array bvh_knee = {"lowerleg"sv,   "lowleg"sv,  "calf"sv,     "shin"sv,
                                 "knee"sv,       "leg"sv,     "tibia"sv,    "legx"sv,
                                 "leglower"sv,   "shank"sv,   "shinbend"sv, "legstretch"sv,
                                 "lowerleg01"sv, "foreleg"sv, "loleg"sv};
constexpr std::array bvh_ankle = {"ankle"sv, "foot"sv, "talus"sv};
constexpr std::array bvh_toe = {"toebase"sv, "toes"sv,     "toe"sv,  "toe0"sv,
                                "ball"sv,    "toejoint"sv, "toe11"sv};
constexpr std::array bvh_chest = {"spine1"sv,     "spine01"sv,    "chest"sv,        "spine2"sv,
                                  "spine02"sv,    "spine"sv,      "torso"sv,        "chestlower"sv,
                                  "chestupper"sv, "upperchest"sv, "abdomenupper"sv, "abdomen"sv};
constexpr std::array bvh_neck = {"neck"sv,  "necktwist01"sv, "lowerneck"sv,
                                 "neck1"sv, "neck01"sv,      "necklower"sv};
constexpr std::array bvh_head = {"head"sv};
constexpr std::array bvh_shoulder = {"upperarm"sv,   "uparm"sv,     "arm"sv,       "humerus"sv,
                                     "shoulder"sv,   "armupper"sv,  "shldrbend"sv, "shldr"sv,
                                     "armstretch"sv, "upperarm01"sv};
constexpr std::array bvh_elbow = {"forearm"sv,    "lowerarm"sv, "lowarm"sv,      "elbow"sv,
                                  "radius"sv,     "armlower"sv, "forearmbend"sv, "forearmstretch"sv,
                                  "lowerarm01"sv, "loarm"sv};
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

/// What exporters put before every name, without digits at its end.
constexpr std::array prefixes = {"ccbase"sv, "mixamorig"sv, "bip"sv,   "character"sv, "skeleton"sv,
                                 "rl"sv,     "jbip"sv,      "robot"sv, "armature"sv,  "def"sv,
                                 "favg"sv,   "mavg"sv,      "actor"sv};

/// A word that this part of all joints begin or end with says nothing of any of them.
constexpr double shared_part = 2.0 / 3.0;

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

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

using NameWords = std::vector<std::string>;

/// The words of a name in lower case, without its name space: "RLowerArm" has three, "Bip01" one.
NameWords words_of(std::string_view name) {
  const std::size_t space = name.find_last_of(":|");
  if (space != std::string_view::npos) name.remove_prefix(space + 1);
  NameWords words;
  bool begins = true;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (!is_upper(c) && !is_lower(c) && !is_digit(c)) {
      begins = true;
      continue;
    }
    const bool after_other = i > 0 && !is_upper(name[i - 1]);
    const bool before_lower = i + 1 < name.size() && is_lower(name[i + 1]);
    if (begins || (is_upper(c) && (after_other || before_lower))) words.emplace_back();
    words.back() += lower(c);
    begins = false;
  }
  return words;
}

std::string joined(const NameWords& words) {
  std::string text;
  for (const std::string& word : words) text += word;
  return text;
}

bool is_prefix(std::string_view text) {
  while (!text.empty() && is_digit(text.back())) text.remove_suffix(1);
  return std::ranges::find(prefixes, text) != prefixes.end();
}

/// Without the number that Blender gives to a name that it has already: "Hand.L.001".
NameWords without_number(NameWords words) {
  constexpr std::array sides = {"l"sv, "r"sv, "left"sv, "right"sv};
  if (words.size() > 2 && std::ranges::all_of(words.back(), is_digit) &&
      std::ranges::find(sides, words[words.size() - 2]) != sides.end()) {
    words.pop_back();
  }
  return words;
}

/// Without the longest of `prefixes` that is not all of the name.
NameWords without_prefix(NameWords words) {
  std::string before;
  std::size_t known = 0;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    before += words[i];
    if (is_prefix(before)) known = i + 1;
  }
  words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(known));
  return words;
}

/// Takes the words out that most names have in one place, until there are none. A name of one word
/// stays as it is.
template <class Place>
void leave_out_shared(std::vector<NameWords>& names, const Place& place) {
  while (true) {
    std::map<std::string, std::size_t> counts;
    std::size_t named = 0;
    for (const NameWords& words : names) {
      if (words.empty()) continue;
      ++named;
      if (words.size() > 1) ++counts[*place(words)];
    }
    const auto most =
        std::ranges::max_element(counts, {}, [](const auto& count) { return count.second; });
    if (most == counts.end() || named < 3) return;
    const std::string shared = most->first;
    if (static_cast<double>(most->second) < shared_part * static_cast<double>(named)) return;
    for (NameWords& words : names) {
      if (words.size() > 1 && *place(words) == shared) words.erase(place(words));
    }
  }
}

bool is_joined(std::string_view name, std::string_view a, std::string_view b) {
  return name.size() == a.size() + b.size() && name.starts_with(a) && name.ends_with(b);
}

}  // namespace

std::span<const std::string_view> words_for(BodyJoint joint, MotionFormat format) {
  return (format == MotionFormat::bvh ? bvh_words : asf_words)[kind_of(joint)];
}

std::string plain_name(std::string_view name) {
  return joined(without_prefix(without_number(words_of(name))));
}

std::vector<std::string> plain_names(const Skeleton& skeleton) {
  std::vector<NameWords> names;
  for (const Joint& joint : skeleton.joints) {
    names.push_back(joint.end_site ? NameWords{} : words_of(joint.name));
  }
  leave_out_shared(names, [](const NameWords& words) { return words.begin(); });
  leave_out_shared(names, [](const NameWords& words) { return words.end() - 1; });
  std::vector<std::string> plain;
  for (NameWords& words : names)
    plain.push_back(joined(without_prefix(without_number(std::move(words)))));
  return plain;
}

bool is_called(std::string_view plain_name, BodyJoint joint, std::string_view word) {
  const Side side = side_of(joint);
  // VRoid says of joints in the middle that they are.
  if (side == Side::none) return plain_name == word || is_joined(plain_name, "c", word);
  const bool left = side == Side::left;
  const std::string_view full = left ? "left" : "right";
  const std::string_view letter = left ? "l" : "r";
  return is_joined(plain_name, full, word) || is_joined(plain_name, letter, word) ||
         is_joined(plain_name, word, full) || is_joined(plain_name, word, letter);
}

}  // namespace reprise
