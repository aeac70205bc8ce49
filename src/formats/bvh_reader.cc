// BVH: a hierarchy of joints, then a line of numbers a frame.
#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/bvh_hierarchy.h"
#include "formats/frame_rates.h"
#include "formats/text_lines.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

/// What a frame time of 0 is taken for, as viewers do.
constexpr double assumed_frame_rate = 60.0;
/// Frame times in milliseconds of up to 1,000 frames a second are beyond this. As seconds they
/// would make days of a minute, and samples of it at even times without end.
constexpr double least_frame_rate = 1.0;

/// The rest of a line after `keyword`, which may be followed by a colon; nothing if it is another
/// line.
std::optional<std::string_view> after_keyword(std::string_view line, std::string_view keyword) {
  line = trimmed(line);
  if (line.size() < keyword.size() ||
      !equal_ignoring_case(line.substr(0, keyword.size()), keyword)) {
    return std::nullopt;
  }
  line = trimmed(line.substr(keyword.size()));
  if (!line.empty() && line.front() == ':') line.remove_prefix(1);
  return trimmed(line);
}

std::string_view next_filled_line(TextLines& lines, const char* what) {
  std::string_view line;
  while (lines.next(line)) {
    if (!trimmed(line).empty()) return line;
  }
  lines.reject(std::string("the file ends before ") + what,
               "it was cut off: copy or export it again");
}

long read_frame_count(TextLines& lines) {
  const auto rest = after_keyword(next_filled_line(lines, "'Frames:'"), "Frames");
  if (!rest) lines.reject("after MOTION comes 'Frames:' with a count");
  const auto count = to_count(*rest);
  if (!count) lines.reject("'Frames:' is followed by " + in_quotes(*rest) + ", which is no count");
  return *count;
}

/// As short as it gives the rate back.
std::string text_of_frame_time(double frame_rate) {
  char digits[32];
  const auto result = std::to_chars(digits, digits + sizeof digits, 1 / frame_rate);
  return {digits, result.ptr};
}

void read_frame_time(TextLines& lines, Take& take, std::optional<double> given_rate) {
  auto rest = after_keyword(next_filled_line(lines, "'Frame Time:'"), "Frame");
  if (rest) rest = after_keyword(*rest, "Time");
  if (!rest) lines.reject("after 'Frames:' comes 'Frame Time:' with the seconds of a frame");
  if (given_rate) {
    if (*given_rate < least_frame_rate) {
      lines.reject("a BVH has a frame a second at least, not the rate of --fps",
                   "give a rate of 1 or more");
    }
    take.frame_rate = *given_rate;
    take.layout.frame_time_text = text_of_frame_time(*given_rate);
    return;
  }
  const auto seconds = to_number(*rest);
  if (!seconds || *seconds < 0) {
    lines.reject("'Frame Time:' is followed by " + in_quotes(*rest) + ", which is no time",
                 "give the rate with --fps");
  }
  take.layout.frame_time_text = std::string(*rest);
  take.frame_rate_assumed = *seconds == 0;
  take.frame_rate = take.frame_rate_assumed ? assumed_frame_rate : 1.0 / *seconds;
  if (!(take.frame_rate >= least_frame_rate && take.frame_rate < 1e6)) {
    lines.reject("a frame time of " + take.layout.frame_time_text + " s cannot be meant",
                 "frame times are in seconds; give the rate with --fps");
  }
}

/// The lines of numbers, a frame each.
class FrameReader {
 public:
  FrameReader(TextLines& lines, Take& take, bool partial)
      : lines_(lines),
        take_(take),
        partial_(partial),
        row_(static_cast<std::size_t>(take.skeleton->channel_count)) {}

  /// `claimed` frames are said to be there, in the line `claim_line`; `left` bytes of text are.
  void read(long claimed, std::size_t claim_line, std::size_t left) {
    take_.channels.resize(most_frames(left), static_cast<Eigen::Index>(row_.size()));
    std::string_view line;
    bool finished = true;  // the line of the last frame
    while (lines_.next(line)) {
      if (trimmed(line).empty() || !read_row(line)) continue;
      std::ranges::copy(row_, take_.channels.row(frames_++).begin());
      finished = !lines_.unfinished();
    }
    if (frames_ < claimed && !finished && frames_ > 1 && partial_) {
      leave_out("the last frame may be cut within its last number, and was left out");
      --frames_;
    }
    take_.channels.conservativeResize(frames_, Eigen::NoChange);
    compare_count(claimed, claim_line);
  }

 private:
  /// No more than are there, and no more than so many bytes can hold: each number has a digit and
  /// something after it.
  Eigen::Index most_frames(std::size_t left) const {
    TextLines ahead = lines_;
    std::string_view line;
    std::size_t filled = 0;
    while (ahead.next(line)) filled += trimmed(line).empty() ? 0 : 1;
    return static_cast<Eigen::Index>(std::min(filled, (left + 1) / (2 * row_.size())));
  }

  /// False where the row is cut off, and left out for that.
  bool read_row(std::string_view line) {
    std::size_t in_row = 0;
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line), ++in_row) {
      const std::optional<double> value = to_number(word);
      if (!value) {
        if (lines_.unfinished() && trimmed(line).empty() && in_row < row_.size()) break;
        lines_.reject_number(word);
      }
      if (in_row < row_.size()) row_[in_row] = *value;
    }
    if (in_row == row_.size()) return true;
    const bool cut = in_row < row_.size() && lines_.nothing_follows();
    if (cut && partial_) {
      leave_out("the last frame is cut off, and was left out");
      return false;
    }
    lines_.reject("a frame has " + std::to_string(in_row) + " numbers where the hierarchy has " +
                      std::to_string(row_.size()) + " channels",
                  cut ? "the recording was cut off; --partial takes the frames before"
                      : "a frame is one line, with a number for each channel");
  }

  void leave_out(const char* what) { take_.notes.push_back({lines_.number(), what}); }

  void compare_count(long claimed, std::size_t claim_line) {
    if (frames_ == claimed) return;
    const std::string said = "'Frames:' says " + std::to_string(claimed);
    if (frames_ < claimed && !partial_) {
      lines_.reject(said + ", but there are " + std::to_string(frames_),
                    "the recording was cut off; --partial takes it as far as it goes");
    }
    take_.notes.push_back(
        {claim_line, said + "; the " + std::to_string(frames_) + " that are there were taken"});
  }

  TextLines& lines_;
  Take& take_;
  bool partial_;
  std::vector<double> row_;
  long frames_ = 0;
};

}  // namespace

Skeleton read_bvh_skeleton(std::string_view text, const std::string& file,
                           double millimetres_per_unit) {
  TextLines lines(text, file);
  return read_bvh_hierarchy(lines, text, millimetres_per_unit, false);
}

Take read_bvh(std::string_view text, const std::string& file, double millimetres_per_unit,
              std::optional<double> frame_rate, bool partial) {
  if (frame_rate) check_frame_rate(*frame_rate);
  TextLines lines(text, file);
  Take take;
  take.skeleton =
      std::make_shared<Skeleton>(read_bvh_hierarchy(lines, text, millimetres_per_unit, true));
  if (take.skeleton->channel_count == 0) {
    lines.reject("no joint has channels", "it is a skeleton alone: export it with its motion");
  }
  const long frames = read_frame_count(lines);
  const std::size_t frames_line = lines.number();
  read_frame_time(lines, take, frame_rate);
  FrameReader(lines, take, partial).read(frames, frames_line, text.size() - lines.position());
  return take;
}

}  // namespace reprise
