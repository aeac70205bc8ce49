#include "formats/bvh_hierarchy.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <string>
#include <vector>

#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

/// In the order of `Channel`.
constexpr std::array<std::string_view, 6> channel_names = {"Xposition", "Yposition", "Zposition",
                                                           "Xrotation", "Yrotation", "Zrotation"};

/// What may stand behind a joint's brace on its line.
constexpr std::array<std::string_view, 5> inner_words = {"OFFSET", "CHANNELS", "JOINT", "End", "}"};
constexpr unsigned char first_beyond_ascii = 0x80;

/// Whether the text is made of whole characters of UTF-8, by their lengths alone.
bool is_utf8(std::string_view text) {
  int open = 0;  // bytes that the character at hand still needs
  for (const char c : text) {
    const int ones = std::countl_one(static_cast<unsigned char>(c));
    if ((open > 0) != (ones == 1) || ones > 4) return false;
    open = open > 0 ? open - 1 : std::max(ones - 1, 0);
  }
  return open == 0;
}

/// Reads the hierarchy, with a stack of its own instead of recursion.
class HierarchyReader {
 public:
  HierarchyReader(TextLines& lines, double millimetres_per_unit) : lines_(lines) {
    skeleton_.format = MotionFormat::bvh;
    skeleton_.millimetres_per_unit = millimetres_per_unit;
  }

  /// Reads up to the line `MOTION`, or to the end of the text where `motion_follows` is false.
  Skeleton read(std::string_view text, bool motion_follows) {
    std::string_view line;
    bool hierarchy = false;
    while (lines_.next(line)) {
      std::string_view rest = line;
      const std::string_view word = next_word(rest);
      if (word.empty()) continue;
      if (!hierarchy) {
        if (!equal_ignoring_case(word, "HIERARCHY")) {
          lines_.reject("a BVH file begins with HIERARCHY, not " + in_quotes(word),
                        "this is no BVH, or something stands before it");
        }
        hierarchy = true;
        statements(next_word(rest), rest);
      } else if (equal_ignoring_case(word, "MOTION")) {
        finish(text.substr(0, lines_.line_start()));
        return std::move(skeleton_);
      } else {
        statements(word, rest);
      }
    }
    if (!hierarchy) lines_.reject("the file is empty", "export it again");
    if (motion_follows) {
      lines_.reject("the file ends before MOTION",
                    open_.empty() ? "it is a skeleton alone: export it with its motion"
                                  : "it was cut off: copy or export it again");
    }
    finish(text);
    return std::move(skeleton_);
  }

 private:
  void statements(std::string_view word, std::string_view& rest) {
    for (; !word.empty(); word = next_word(rest)) statement(word, rest);
  }

  /// One statement; takes its words off the front of `rest`, so that others may follow on the line.
  void statement(std::string_view word, std::string_view& rest) {
    if (equal_ignoring_case(word, "ROOT") || equal_ignoring_case(word, "JOINT")) {
      begin_joint(take_name(rest), false);
    } else if (equal_ignoring_case(word, "End")) {
      begin_joint(take_name(rest), true);
    } else if (word == "{") {
      open_brace();
    } else if (word == "}") {
      close_brace();
    } else if (equal_ignoring_case(word, "OFFSET")) {
      offset(rest);
    } else if (equal_ignoring_case(word, "CHANNELS")) {
      channels(rest);
    } else if (open_.empty() && equal_ignoring_case(word.substr(0, 5), "Frame")) {
      lines_.reject("the line MOTION is missing before " + in_quotes(word),
                    "put it in front of this line");
    } else {
      lines_.reject("there is no such word in a BVH hierarchy: " + in_quotes(word));
    }
  }

  /// A name is all up to the line's end or a brace, which stays in `rest`.
  std::string_view take_name(std::string_view& rest) const {
    std::size_t end = rest.find('{');
    while (end < rest.size() && within_character(rest, end)) end = rest.find('{', end + 1);
    end = std::min(end, rest.size());
    const std::string_view name = trimmed(rest.substr(0, end));
    rest.remove_prefix(end);
    return name;
  }

  /// Whether the brace at `place` is the second byte of a character, as of Shift-JIS or GBK: then
  /// it comes right after a byte that is not ASCII, and what follows is none of a hierarchy.
  bool within_character(std::string_view line, std::size_t place) const {
    if (place == 0 || static_cast<unsigned char>(line[place - 1]) < first_beyond_ascii ||
        is_utf8(line.substr(0, place))) {
      return false;
    }
    std::string_view rest = line.substr(place + 1);
    const std::string_view word = next_word(rest);
    if (!word.empty()) {
      return std::ranges::none_of(
          inner_words, [&](std::string_view inner) { return equal_ignoring_case(word, inner); });
    }
    // The joint's own brace may be on a line below.
    TextLines ahead = lines_;
    std::string_view next;
    while (ahead.next(next)) {
      if (!trimmed(next).empty()) return trimmed(next).front() == '{';
    }
    return false;
  }

  void begin_joint(std::string_view name, bool end_site) {
    if (waiting_) lines_.reject("a joint begins before the brace of the one above it");
    if (open_.empty() && !skeleton_.joints.empty()) {
      lines_.reject("there is a second ROOT",
                    "give each its own file, or make it a JOINT of the first one");
    }
    if (open_.empty() && end_site) lines_.reject("an end site stands outside of every joint");
    if (!open_.empty() && skeleton_.joints[open_.back()].end_site) {
      lines_.reject("an end site has a child");
    }
    if (name.size() > InputLimits::name_bytes) {
      lines_.reject("a name is longer than " + std::to_string(InputLimits::name_bytes) + " bytes");
    }
    if (name.empty() && !end_site) lines_.reject("a joint has no name");
    if (skeleton_.joints.size() >= InputLimits::joints) {
      lines_.reject("there are more than " + std::to_string(InputLimits::joints) + " joints");
    }
    Joint joint;
    joint.name = end_site ? std::string() : std::string(name);
    joint.parent = open_.empty() ? -1 : open_.back();
    joint.end_site = end_site;
    skeleton_.joints.push_back(std::move(joint));
    waiting_ = true;
  }

  void open_brace() {
    if (!waiting_) lines_.reject("a brace opens without a joint before it");
    waiting_ = false;
    if (open_.size() >= InputLimits::depth) {
      lines_.reject("joints are nested deeper than " + std::to_string(InputLimits::depth));
    }
    open_.push_back(static_cast<int>(skeleton_.joints.size()) - 1);
  }

  void close_brace() {
    if (waiting_ || open_.empty()) lines_.reject("a brace closes that was never opened");
    open_.pop_back();
  }

  Joint& current() {
    if (waiting_ || open_.empty())
      lines_.reject("this line stands outside of every joint's braces");
    return skeleton_.joints[open_.back()];
  }

  void offset(std::string_view& rest) {
    Joint& joint = current();
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = next_word(rest);
      const std::optional<double> value = to_number(word);
      if (!value) lines_.reject_number(word, "OFFSET needs three numbers; ");
      joint.offset[axis] = *value;
    }
  }

  Channel channel_named(std::string_view word) const {
    const auto* name = std::ranges::find_if(
        channel_names, [&](std::string_view n) { return equal_ignoring_case(n, word); });
    if (name == channel_names.end()) {
      lines_.reject(word.empty() ? "CHANNELS names fewer channels than it says"
                                 : "there is no such channel: " + in_quotes(word));
    }
    return static_cast<Channel>(name - channel_names.begin());
  }

  void refuse_scales(std::string_view rest) const {
    constexpr std::string_view scale = "scale";
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
      if (word.size() < scale.size()) continue;
      if (equal_ignoring_case(word.substr(word.size() - scale.size()), scale)) {
        lines_.reject("the channel " + in_quotes(word) + " scales its joint, which is not read",
                      "export it without scale channels");
      }
    }
  }

  void channels(std::string_view& rest) {
    Joint& joint = current();
    if (joint.end_site) lines_.reject("an end site has no channels");
    if (!joint.channels.empty()) lines_.reject("a joint has CHANNELS twice");
    refuse_scales(rest);
    const std::string_view count_word = next_word(rest);
    const std::optional<long> count = to_count(count_word);
    if (!count || *count > 6)
      lines_.reject("CHANNELS needs a count of 0 to 6, not " + in_quotes(count_word),
                    "a joint has up to three positions and three rotations");
    for (long c = 0; c < *count; ++c) {
      const std::string_view word = next_word(rest);
      const Channel channel = channel_named(word);
      if (is_position(channel) && std::ranges::count(joint.channels, channel) > 0) {
        lines_.reject("a joint has the channel " + in_quotes(word) + " twice");
      }
      if (is_rotation(channel)) {
        joint.rotation_order.push_back(axis_of(channel));
        joint.rotation_slots.push_back(static_cast<int>(c));
      }
      joint.channels.push_back(channel);
    }
    skeleton_.channel_count += static_cast<int>(*count);
    if (skeleton_.channel_count > static_cast<int>(InputLimits::channels)) {
      lines_.reject("there are more than " + std::to_string(InputLimits::channels) + " channels");
    }
  }

  /// Columns go by joints, even where a joint's CHANNELS stand behind its children.
  void finish(std::string_view source) {
    if (!open_.empty() || waiting_) lines_.reject("the hierarchy ends with a brace left open");
    if (skeleton_.joints.empty()) lines_.reject("the hierarchy has no ROOT");
    int first = 0;
    for (Joint& joint : skeleton_.joints) {
      joint.first_channel = first;
      first += static_cast<int>(joint.channels.size());
    }
    skeleton_.source_text = std::string(source);
  }

  TextLines& lines_;
  Skeleton skeleton_;
  std::vector<int> open_;
  bool waiting_ = false;
};

}  // namespace

Skeleton read_bvh_hierarchy(TextLines& lines, std::string_view text, double millimetres_per_unit,
                            bool motion_follows) {
  return HierarchyReader(lines, millimetres_per_unit).read(text, motion_follows);
}

}  // namespace reprise
