// AMC: for each frame its number, then a line a bone with the values of its degrees of freedom.
#include <algorithm>
#include <map>

#include "formats/frame_rates.h"
#include "formats/text_lines.h"
#include "model/angle_units.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

constexpr double default_frame_rate = 120.0;           // CMU's, which most AMC files come from
constexpr long most_frame_number = 1'000'000'000'000;  // far from where sums of it overflow

/// Bones have values for turns that are no degrees of freedom of theirs.
constexpr std::string_view all_turns_keyword = ":FORCE-ALL-JOINTS-BE-3DOF";

class AmcReader {
 public:
  AmcReader(std::string_view text, const std::string& file, Take& take, bool partial)
      : text_(text), lines_(text, file), take_(take), partial_(partial) {
    use_skeleton();
    take.layout.radians = take.skeleton->radians;
  }

  void read() {
    std::string_view line;
    while (!cut_ && lines_.next(line)) {
      std::string_view rest = line.substr(0, line.find('#'));
      const std::string_view word = next_word(rest);
      if (word.empty()) continue;
      if (word.front() == ':') {
        if (frames_ > 0) lines_.reject("a keyword stands between frames: " + in_quotes(word));
        keyword(word, rest);
      } else if (trimmed(rest).empty() && to_count(word)) {
        begin_frame(*to_count(word));
      } else {
        bone(word, rest);
      }
    }
    if (!cut_) end_frame(true);
    if (cut_) {
      --frames_;
      take_.notes.push_back({lines_.number(), "the last frame is cut off, and was left out"});
    }
    if (frames_ == 0) lines_.reject("there are no frames", "it is not an AMC, or has no motion");
    take_.channels = Eigen::Map<ChannelMatrix>(values_.data(), frames_, skeleton_->channel_count);
  }

 private:
  void use_skeleton() {
    skeleton_ = take_.skeleton.get();
    index_.clear();
    for (std::size_t j = 0; j < skeleton_->joints.size(); ++j) {
      index_.emplace(skeleton_->joints[j].name, static_cast<int>(j));
    }
    row_.assign(static_cast<std::size_t>(skeleton_->channel_count), 0.0);
  }

  void keyword(std::string_view word, std::string_view rest) {
    if (equal_ignoring_case(word, ":RADIANS")) take_.layout.radians = true;
    if (equal_ignoring_case(word, ":DEGREES")) take_.layout.radians = false;
    if (equal_ignoring_case(word, ":SAMPLES-PER-SECOND")) frame_rate(next_word(rest));
    if (equal_ignoring_case(word, all_turns_keyword)) give_all_turns();
  }

  void give_all_turns() {
    auto skeleton = std::make_shared<Skeleton>(
        read_asf(take_.skeleton->source_text, take_.skeleton->asf_name + ".asf", true));
    skeleton->asf_name = take_.skeleton->asf_name;
    take_.skeleton = std::move(skeleton);
    use_skeleton();
  }

  /// Of a frame behind the first, in the last line that is filled, such a fault is an end that came
  /// too early; the frame is left out where that is wished.
  void cut_or_reject(const std::string& why, const std::string& advice = {}) {
    if (frames_ < 2 || !lines_.nothing_follows()) lines_.reject(why, advice);
    if (!partial_) {
      lines_.reject(why, "if the recording was cut off, --partial takes the frames before");
    }
    cut_ = true;
  }

  /// Few files say it; what is asked for comes before it.
  void frame_rate(std::string_view word) {
    if (!take_.frame_rate_assumed) return;
    const std::optional<double> rate = to_number(word);
    if (!rate || !is_frame_rate(*rate)) {
      lines_.reject(in_quotes(word) + " is no number of frames a second", "give one with --fps");
    }
    take_.frame_rate = *rate;
    take_.frame_rate_assumed = false;
  }

  void begin_frame(long number) {
    if (number > most_frame_number) {
      lines_.reject("frame numbers end at " + std::to_string(most_frame_number));
    }
    if (frames_ == 0) {
      take_.layout.first_frame_number = number;
      take_.layout.amc_header = std::string(text_.substr(0, lines_.line_start()));
    } else {
      end_frame(false);
      if (number != take_.layout.first_frame_number + frames_) {
        reject_number_of_frame(number);
        return;
      }
    }
    ++frames_;
    next_bone_ = 0;
  }

  /// The last line may be the beginning of a number.
  void reject_number_of_frame(long number) {
    const std::string should = std::to_string(take_.layout.first_frame_number + frames_);
    const std::string why =
        "frame " + std::to_string(number) + " comes where frame " + should + " should";
    if (lines_.unfinished() && should.starts_with(std::to_string(number)) && partial_) {
      ++frames_;
      cut_ = true;
      return;
    }
    lines_.reject(why, "frames are numbered one after another: some may be missing");
  }

  void end_frame(bool last) {
    if (frames_ == 0) return;
    if (next_bone_ != take_.layout.amc_joints.size()) {
      const Joint& missing = skeleton_->joints[take_.layout.amc_joints[next_bone_]];
      const std::string why =
          "the frame before this line leaves out the bone " + in_quotes(missing.name);
      if (!last) lines_.reject(why);
      cut_or_reject(why);
      return;
    }
    if (frames_ == 1) check_share();
    values_.insert(values_.end(), row_.begin(), row_.end());
  }

  /// Frames take memory for all channels of the skeleton, so they have to give a share of them.
  void check_share() const {
    std::size_t given = 0;
    for (const int joint : take_.layout.amc_joints)
      given += skeleton_->joints[joint].channels.size();
    if (given * InputLimits::channels_per_value < row_.size()) {
      lines_.reject("the first frame gives " + std::to_string(given) + " of its skeleton's " +
                        std::to_string(row_.size()) + " values, less than one in " +
                        std::to_string(InputLimits::channels_per_value),
                    "this may be another skeleton's");
    }
  }

  void bone(std::string_view word, std::string_view rest) {
    if (frames_ == 0) lines_.reject("a bone's values come before the first frame's number");
    std::vector<int>& bones = take_.layout.amc_joints;
    const bool first = frames_ == 1;
    if (first) {
      const auto found = index_.find(word);
      if (found == index_.end()) {
        lines_.reject("the skeleton has no bone " + in_quotes(word),
                      "if it is another one's, name the right ASF with --asf");
      }
      if (std::ranges::count(bones, found->second) > 0) {
        lines_.reject("a frame has the bone " + in_quotes(word) + " twice");
      }
      bones.push_back(found->second);
    } else if (next_bone_ >= bones.size() || skeleton_->joints[bones[next_bone_]].name != word) {
      const std::string why =
          "the bones of this frame are not those of the first: " + in_quotes(word);
      const bool begins = next_bone_ < bones.size() && trimmed(rest).empty() &&
                          skeleton_->joints[bones[next_bone_]].name.starts_with(word);
      if (!begins) lines_.reject(why);
      cut_or_reject(why);
      return;
    }
    values(skeleton_->joints[bones[next_bone_++]], rest);
  }

  void values(const Joint& joint, std::string_view rest) {
    const double scale = take_.layout.radians ? degrees_per_radian : 1.0;
    std::size_t c = 0;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest), ++c) {
      const std::optional<double> value = to_number(word);
      if (!value) {
        if (!lines_.unfinished()) lines_.reject_number(word);
        const NumberFault fault = number_fault(word);
        cut_or_reject(fault.why, fault.advice);
        return;
      }
      if (c < joint.channels.size()) {
        row_[joint.first_channel + c] = is_rotation(joint.channels[c]) ? *value * scale : *value;
      }
    }
    if (c == joint.channels.size()) return;
    const std::string why = "the bone " + in_quotes(joint.name) + " has " + std::to_string(c) +
                            " values where its skeleton has " +
                            std::to_string(joint.channels.size()) + " degrees of freedom";
    const std::string advice = "if it is another skeleton's, name the right ASF with --asf";
    if (c > joint.channels.size()) lines_.reject(why, advice);
    cut_or_reject(why, advice);
  }

  std::string_view text_;
  TextLines lines_;
  Take& take_;
  bool partial_;
  bool cut_ = false;
  const Skeleton* skeleton_ = nullptr;  ///< the take's
  std::map<std::string, int, std::less<>> index_;
  std::vector<double> row_, values_;
  long frames_ = 0;
  std::size_t next_bone_ = 0;
};

}  // namespace

Take read_amc(std::string_view text, const std::string& file,
              std::shared_ptr<const Skeleton> skeleton, std::optional<double> frame_rate,
              bool partial) {
  if (frame_rate) check_frame_rate(*frame_rate);
  Take take;
  take.skeleton = std::move(skeleton);
  take.frame_rate = frame_rate.value_or(default_frame_rate);
  take.frame_rate_assumed = !frame_rate.has_value();
  AmcReader(text, file, take, partial).read();
  return take;
}

bool amc_has_all_turns(std::string_view header) {
  TextLines lines(header, {});
  std::string_view line;
  while (lines.next(line)) {
    if (equal_ignoring_case(next_word(line), all_turns_keyword)) return true;
  }
  return false;
}

}  // namespace reprise
