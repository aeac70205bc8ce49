// ASF: a skeleton in sections; a bone has a direction, a length, axes and degrees of freedom.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/asf_bone.h"
#include "formats/text_lines.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

using Eigen::Vector3d;

/// In the order of `Channel`.
constexpr std::array<std::string_view, 7> channel_words = {"TX", "TY", "TZ", "RX", "RY", "RZ", "L"};
constexpr double millimetres_per_inch = 25.4;

/// "XYZ" as axes, the first of which turns first.
std::optional<std::vector<int>> axis_order(std::string_view word) {
  if (word.size() != 3) return std::nullopt;
  std::vector<int> order;
  for (const char c : word) {
    const auto axis = std::string_view("XYZ").find(static_cast<char>(c >= 'a' ? c - 32 : c));
    if (axis == std::string_view::npos || std::ranges::count(order, static_cast<int>(axis)) > 0) {
      return std::nullopt;
    }
    order.push_back(static_cast<int>(axis));
  }
  return order;
}

class AsfReader {
 public:
  AsfReader(std::string_view text, const std::string& file, bool all_turns)
      : lines_(text, file), all_turns_(all_turns) {
    skeleton_.format = MotionFormat::asf_amc;
    skeleton_.millimetres_per_unit = millimetres_per_inch;
    skeleton_.source_text = std::string(text);
    bones_.emplace_back().name = "root";
  }

  Skeleton read() {
    std::string_view line;
    while (lines_.next(line)) {
      line = line.substr(0, line.find('#'));
      std::string_view rest = line;
      const std::string_view word = next_word(rest);
      if (word.empty()) continue;
      if (word.front() == ':') {
        section_ = std::string(word.substr(1));
        if (in_bone_) lines_.reject("a bone has no 'end'");
        if (equal_ignoring_case(section_, "units")) units(next_word(rest), rest);
      } else if (equal_ignoring_case(section_, "units")) {
        units(word, rest);
      } else if (equal_ignoring_case(section_, "root")) {
        root(word, rest);
      } else if (equal_ignoring_case(section_, "bonedata")) {
        bone(word, rest);
      } else if (equal_ignoring_case(section_, "hierarchy")) {
        hierarchy(word, rest);
      } else if (section_.empty()) {
        lines_.reject("an ASF file begins with a section such as ':version', not " +
                      in_quotes(word));
      }
    }
    return finish();
  }

 private:
  double number(std::string_view& rest, const char* what) {
    const std::string_view word = next_word(rest);
    const std::optional<double> value = to_number(word);
    if (!value) lines_.reject_number(word, std::string(what) + " needs a number; ");
    return *value;
  }

  Vector3d vector(std::string_view& rest, const char* what) {
    Vector3d result;
    for (double& value : result) value = number(rest, what);
    return result;
  }

  /// Pairs of a word and a value, one a line or several.
  void units(std::string_view word, std::string_view rest) {
    for (; !word.empty(); word = next_word(rest)) {
      if (equal_ignoring_case(word, "length")) {
        length_unit(number(rest, "'length'"));
      } else if (equal_ignoring_case(word, "angle")) {
        angle_unit(next_word(rest));
      } else {
        next_word(rest);
      }
    }
  }

  void length_unit(double length) {
    if (!(length > 0)) lines_.reject("'length' must be greater than 0");
    if (length * InputLimits::magnitude < 1) {
      lines_.reject("a 'length' of " + std::to_string(length) + " cannot be meant",
                    "most files have 0.45 or 1");
    }
    skeleton_.millimetres_per_unit = millimetres_per_inch / length;
  }

  void angle_unit(std::string_view unit) {
    radians_ = equal_ignoring_case(unit.substr(0, 3), "rad");
    if (!radians_ && !equal_ignoring_case(unit.substr(0, 3), "deg")) {
      lines_.reject("'angle' is deg or rad, not " + in_quotes(unit));
    }
  }

  void root(std::string_view word, std::string_view rest) {
    AsfBone& root = bones_.front();
    if (equal_ignoring_case(word, "order")) {
      degrees_of_freedom(root, rest);
    } else if (equal_ignoring_case(word, "axis")) {
      root.axis_order = order(rest);
    } else if (equal_ignoring_case(word, "position")) {
      root.direction = vector(rest, "'position'");
    } else if (equal_ignoring_case(word, "orientation")) {
      root.axis_angles = vector(rest, "'orientation'");
    }
  }

  std::vector<int> order(std::string_view& rest) {
    const std::string_view word = next_word(rest);
    const auto axes = axis_order(word);
    if (!axes) lines_.reject("an axis order is three letters such as XYZ, not " + in_quotes(word));
    return *axes;
  }

  void degrees_of_freedom(AsfBone& bone, std::string_view rest) {
    bone.degrees_of_freedom.clear();
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
      const auto* name = std::ranges::find_if(
          channel_words, [&](std::string_view n) { return equal_ignoring_case(n, word); });
      if (name == channel_words.end())
        lines_.reject("there is no such degree of freedom: " + in_quotes(word));
      const auto channel = static_cast<Channel>(name - channel_words.begin());
      if (std::ranges::count(bone.degrees_of_freedom, channel) > 0) {
        lines_.reject("a bone has the degree of freedom " + in_quotes(word) + " twice");
      }
      bone.degrees_of_freedom.push_back(channel);
    }
  }

  void bone(std::string_view word, std::string_view rest) {
    if (equal_ignoring_case(word, "begin")) {
      if (in_bone_) lines_.reject("a bone begins inside of another");
      if (bones_.size() >= InputLimits::joints) {
        lines_.reject("there are more than " + std::to_string(InputLimits::joints) + " bones");
      }
      in_bone_ = true;
      bones_.emplace_back();
    } else if (!in_bone_) {
      lines_.reject("bone data stands outside of 'begin' and 'end': " + in_quotes(word));
    } else if (equal_ignoring_case(word, "end")) {
      end_bone();
    } else if (equal_ignoring_case(word, "name")) {
      bones_.back().name = std::string(trimmed(rest));
      if (bones_.back().name.size() > InputLimits::name_bytes) lines_.reject("a name is too long");
    } else if (equal_ignoring_case(word, "direction")) {
      bones_.back().direction = vector(rest, "'direction'");
    } else if (equal_ignoring_case(word, "length")) {
      bones_.back().length = number(rest, "'length'");
    } else if (equal_ignoring_case(word, "axis")) {
      bones_.back().axis_angles = vector(rest, "'axis'");
      if (!trimmed(rest).empty()) bones_.back().axis_order = order(rest);
    } else if (equal_ignoring_case(word, "dof")) {
      degrees_of_freedom(bones_.back(), rest);
    }
  }

  void end_bone() {
    in_bone_ = false;
    const std::string& name = bones_.back().name;
    if (name.empty()) lines_.reject("a bone has no name");
    if (!index_.emplace(name, bones_.size() - 1).second || name == "root") {
      lines_.reject("there are two bones named " + in_quotes(name));
    }
  }

  void hierarchy(std::string_view word, std::string_view rest) {
    if (equal_ignoring_case(word, "begin") || equal_ignoring_case(word, "end")) return;
    const std::size_t parent = bone_index(word);
    for (std::string_view child = next_word(rest); !child.empty(); child = next_word(rest)) {
      const std::size_t bone = bone_index(child);
      if (bone == 0 || parents_.contains(bone))
        lines_.reject(in_quotes(child) + " has two parents");
      if (parent != 0 && !parents_.contains(parent)) {
        lines_.reject(in_quotes(word) + " has children before it has a parent");
      }
      parents_[bone] = parent;
      in_order_.push_back(bone);
    }
  }

  std::size_t bone_index(std::string_view name) const {
    if (name == "root") return 0;
    const auto found = index_.find(name);
    if (found == index_.end())
      lines_.reject("the hierarchy names a bone that is not there: " + in_quotes(name));
    return found->second;
  }

  /// A bone without degrees of freedom does not move even then.
  static void add_missing_turns(AsfBone& bone) {
    std::vector<Channel>& own = bone.degrees_of_freedom;
    if (own.empty()) return;
    for (const Channel turn : {Channel::x_rotation, Channel::y_rotation, Channel::z_rotation}) {
      if (std::ranges::count(own, turn) == 0) own.push_back(turn);
    }
  }

  Skeleton finish() {
    if (all_turns_) std::ranges::for_each(bones_, add_missing_turns);
    skeleton_.radians = radians_;
    if (in_bone_) lines_.reject("the file ends inside of a bone");
    if (bones_.front().degrees_of_freedom.empty())
      lines_.reject("the skeleton's root has no 'order'");
    if (in_order_.size() + 1 != bones_.size()) {
      for (const auto& [name, bone] : index_) {
        if (!parents_.contains(bone))
          lines_.reject("the hierarchy leaves out the bone " + in_quotes(name));
      }
    }
    std::map<std::size_t, int> joints{{0, 0}};  // of bones
    add_joint(bones_.front(), -1);
    for (const std::size_t bone : in_order_) {
      joints[bone] = static_cast<int>(skeleton_.joints.size());
      add_joint(bones_[bone], joints.at(parents_.at(bone)));
    }
    if (skeleton_.channel_count > static_cast<int>(InputLimits::channels)) {
      lines_.reject("there are more than " + std::to_string(InputLimits::channels) + " channels");
    }
    return std::move(skeleton_);
  }

  void add_joint(const AsfBone& bone, int parent) {
    Joint joint = joint_of(bone, radians_);
    joint.parent = parent;
    joint.first_channel = skeleton_.channel_count;
    skeleton_.channel_count += static_cast<int>(joint.channels.size());
    skeleton_.joints.push_back(std::move(joint));
  }

  TextLines lines_;
  Skeleton skeleton_;
  std::string section_;
  bool all_turns_;
  bool radians_ = false;
  bool in_bone_ = false;
  std::vector<AsfBone> bones_;  // the root, then bones as they come
  std::map<std::string, std::size_t, std::less<>> index_;
  std::map<std::size_t, std::size_t> parents_;
  std::vector<std::size_t> in_order_;  // of the hierarchy: bones behind their parents
};

}  // namespace

Skeleton read_asf(std::string_view text, const std::string& file, bool all_turns) {
  return AsfReader(text, file, all_turns).read();
}

}  // namespace reprise
