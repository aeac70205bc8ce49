// BVH: a hierarchy of joints, then a line of numbers a frame.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/bvh_hierarchy.h"
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
  lines.reject(std::string("the file ends before ") + what);
}

long read_frame_count(TextLines& lines) {
  const auto rest = after_keyword(next_filled_line(lines, "'Frames:'"), "Frames");
  if (!rest) lines.reject("after MOTION comes 'Frames:' with a count");
  const auto count = to_count(*rest);
  if (!count) lines.reject("'Frames:' is followed by " + in_quotes(*rest) + ", which is no count");
  return *count;
}

void read_frame_time(TextLines& lines, Take& take) {
  auto rest = after_keyword(next_filled_line(lines, "'Frame Time:'"), "Frame");
  if (rest) rest = after_keyword(*rest, "Time");
  if (!rest) lines.reject("after 'Frames:' comes 'Frame Time:' with the seconds of a frame");
  const auto seconds = to_number(*rest);
  if (!seconds || *seconds < 0) {
    lines.reject("'Frame Time:' is followed by " + in_quotes(*rest) + ", which is no time");
  }
  take.layout.frame_time_text = std::string(*rest);
  take.frame_rate_assumed = *seconds == 0;
  take.frame_rate = take.frame_rate_assumed ? assumed_frame_rate : 1.0 / *seconds;
  if (!(take.frame_rate >= least_frame_rate && take.frame_rate < 1e6)) {
    lines.reject("a frame time of " + take.layout.frame_time_text + " s cannot be meant",
                 "frame times are in seconds");
  }
}

void read_frames(TextLines& lines, long frames, Take& take) {
  const std::size_t width = static_cast<std::size_t>(take.skeleton->channel_count);
  std::vector<double> values;
  std::string_view line;
  long rows = 0;
  while (lines.next(line)) {
    std::size_t in_row = 0;
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
      const std::optional<double> value = to_number(word);
      if (!value) lines.reject(why_no_number(word));
      values.push_back(*value);
      ++in_row;
    }
    if (in_row == 0) continue;
    if (in_row != width) {
      lines.reject("a frame has " + std::to_string(in_row) + " numbers where the hierarchy has " +
                       std::to_string(width) + " channels",
                   "a frame is one line");
    }
    ++rows;
  }
  if (rows != frames) {
    lines.reject("'Frames:' says " + std::to_string(frames) + ", but there are " +
                 std::to_string(rows));
  }
  take.channels = Eigen::Map<ChannelMatrix>(values.data(), rows, static_cast<Eigen::Index>(width));
}

}  // namespace

Skeleton read_bvh_skeleton(std::string_view text, const std::string& file,
                           double millimetres_per_unit) {
  TextLines lines(text, file);
  return read_bvh_hierarchy(lines, text, millimetres_per_unit, false);
}

Take read_bvh(std::string_view text, const std::string& file, double millimetres_per_unit) {
  TextLines lines(text, file);
  Take take;
  take.skeleton =
      std::make_shared<Skeleton>(read_bvh_hierarchy(lines, text, millimetres_per_unit, true));
  if (take.skeleton->channel_count == 0) lines.reject("no joint has channels");
  const long frames = read_frame_count(lines);
  read_frame_time(lines, take);
  read_frames(lines, frames, take);
  return take;
}

}  // namespace reprise
