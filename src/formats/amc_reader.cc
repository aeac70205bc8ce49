// AMC: for each frame its number, then a line a bone with the values of its degrees of freedom.
#include <algorithm>
#include <map>

#include "formats/text_lines.h"
#include "model/angle_units.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

constexpr double default_frame_rate = 120.0;           // CMU's, which most AMC files come from
constexpr long most_frame_number = 1'000'000'000'000;  // far from where sums of it overflow

class AmcReader {
 public:
  AmcReader(std::string_view text, const std::string& file, const Skeleton& skeleton)
      : text_(text), lines_(text, file), skeleton_(skeleton) {
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
      index_.emplace(skeleton.joints[j].name, static_cast<int>(j));
    }
    row_.assign(static_cast<std::size_t>(skeleton.channel_count), 0.0);
  }

  void read(Take& take) {
    take_ = &take;
    std::string_view line;
    while (lines_.next(line)) {
      std::string_view rest = line.substr(0, line.find('#'));
      const std::string_view word = next_word(rest);
      if (word.empty()) continue;
      if (word.front() == ':') {
        if (frames_ > 0) lines_.reject("a keyword stands between frames: " + in_quotes(word));
        if (equal_ignoring_case(word, ":RADIANS")) take.layout.radians = true;
        if (equal_ignoring_case(word, ":DEGREES")) take.layout.radians = false;
        if (equal_ignoring_case(word, ":SAMPLES-PER-SECOND")) frame_rate(next_word(rest));
      } else if (trimmed(rest).empty() && to_count(word)) {
        begin_frame(*to_count(word));
      } else {
        bone(word, rest);
      }
    }
    end_frame();
    if (frames_ == 0) lines_.reject("there are no frames");
    take.channels = Eigen::Map<ChannelMatrix>(values_.data(), frames_, skeleton_.channel_count);
  }

 private:
  /// Few files say it; what is asked for comes before it.
  void frame_rate(std::string_view word) {
    if (!take_->frame_rate_assumed) return;
    const std::optional<double> rate = to_number(word);
    if (!rate || !is_frame_rate(*rate)) {
      lines_.reject(in_quotes(word) + " is no number of frames a second", "give one with --fps");
    }
    take_->frame_rate = *rate;
    take_->frame_rate_assumed = false;
  }

  void begin_frame(long number) {
    if (number > most_frame_number) {
      lines_.reject("frame numbers end at " + std::to_string(most_frame_number));
    }
    if (frames_ == 0) {
      take_->layout.first_frame_number = number;
      take_->layout.amc_header = std::string(text_.substr(0, lines_.line_start()));
    } else {
      end_frame();
      if (number != take_->layout.first_frame_number + frames_) {
        lines_.reject("frame " + std::to_string(number) + " comes where frame " +
                      std::to_string(take_->layout.first_frame_number + frames_) + " should");
      }
    }
    ++frames_;
    next_bone_ = 0;
  }

  void end_frame() {
    if (frames_ == 0) return;
    if (next_bone_ != take_->layout.amc_joints.size()) {
      lines_.reject("the frame before this line leaves out the bone " +
                    in_quotes(skeleton_.joints[take_->layout.amc_joints[next_bone_]].name));
    }
    if (frames_ == 1) check_share();
    values_.insert(values_.end(), row_.begin(), row_.end());
  }

  /// Frames take memory for all channels of the skeleton, so they have to give a share of them.
  void check_share() const {
    std::size_t given = 0;
    for (const int joint : take_->layout.amc_joints)
      given += skeleton_.joints[joint].channels.size();
    if (given * InputLimits::channels_per_value < row_.size()) {
      lines_.reject("the first frame gives " + std::to_string(given) + " of its skeleton's " +
                        std::to_string(row_.size()) + " values, less than one in " +
                        std::to_string(InputLimits::channels_per_value),
                    "this may be another skeleton's");
    }
  }

  void bone(std::string_view word, std::string_view rest) {
    if (frames_ == 0) lines_.reject("a bone's values come before the first frame's number");
    std::vector<int>& bones = take_->layout.amc_joints;
    const bool first = frames_ == 1;
    if (first) {
      const auto found = index_.find(word);
      if (found == index_.end()) lines_.reject("the skeleton has no bone " + in_quotes(word));
      if (std::ranges::count(bones, found->second) > 0) {
        lines_.reject("a frame has the bone " + in_quotes(word) + " twice");
      }
      bones.push_back(found->second);
    } else if (next_bone_ >= bones.size() || skeleton_.joints[bones[next_bone_]].name != word) {
      lines_.reject("the bones of this frame are not those of the first: " + in_quotes(word));
    }
    values(skeleton_.joints[bones[next_bone_++]], rest);
  }

  void values(const Joint& joint, std::string_view rest) {
    const double scale = take_->layout.radians ? degrees_per_radian : 1.0;
    std::size_t c = 0;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest), ++c) {
      const std::optional<double> value = to_number(word);
      if (!value) lines_.reject(why_no_number(word));
      if (c < joint.channels.size()) {
        row_[joint.first_channel + c] = is_rotation(joint.channels[c]) ? *value * scale : *value;
      }
    }
    if (c != joint.channels.size()) {
      lines_.reject("the bone " + in_quotes(joint.name) + " has " + std::to_string(c) +
                    " values where its skeleton has " + std::to_string(joint.channels.size()) +
                    " degrees of freedom");
    }
  }

  std::string_view text_;
  TextLines lines_;
  const Skeleton& skeleton_;
  Take* take_ = nullptr;
  std::map<std::string, int, std::less<>> index_;
  std::vector<double> row_, values_;
  long frames_ = 0;
  std::size_t next_bone_ = 0;
};

}  // namespace

Take read_amc(std::string_view text, const std::string& file,
              std::shared_ptr<const Skeleton> skeleton, std::optional<double> frame_rate) {
  if (frame_rate && !is_frame_rate(*frame_rate)) {
    throw Error(ErrorCode::usage,
                "no motion has " + std::to_string(*frame_rate) + " frames a second");
  }
  Take take;
  take.skeleton = std::move(skeleton);
  take.frame_rate = frame_rate.value_or(default_frame_rate);
  take.frame_rate_assumed = !frame_rate.has_value();
  AmcReader(text, file, *take.skeleton).read(take);
  return take;
}

}  // namespace reprise
