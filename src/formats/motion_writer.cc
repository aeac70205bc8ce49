// Takes as text, in the format of their source and with its header.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "model/angle_units.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

/// The line end that a text uses first; LF where it has none.
std::string line_end_of(std::string_view text) {
  const std::size_t end = text.find_first_of("\r\n");
  if (end == std::string_view::npos || text[end] == '\n') return "\n";
  return end + 1 < text.size() && text[end + 1] == '\n' ? "\r\n" : "\r";
}

void append_value(std::string& text, double value, int decimals) {
  char digits[400];
  const auto result =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, decimals);
  std::string_view word(digits, static_cast<std::size_t>(result.ptr - digits));
  // Rounding to nothing leaves a sign behind.
  if (word.front() == '-' && word.find_first_not_of("-0.") == std::string_view::npos)
    word.remove_prefix(1);
  text += word;
}

/// What rounding may move a joint by is to be the same in every unit. Bodies are as large as their
/// unit, so that turns need as many more digits as lengths; a radian is two digits of degrees.
int fitting_decimals(const Take& take) {
  constexpr double millimetres_at_six = 100;
  constexpr int usual = 6, of_radians = 2, most = 15;
  const double larger = take.skeleton->millimetres_per_unit / millimetres_at_six;
  const int more = larger > 1 ? static_cast<int>(std::ceil(std::log10(larger))) : 0;
  return std::min(most, usual + more + (take.layout.radians ? of_radians : 0));
}

}  // namespace

std::string write_bvh(const Take& take, std::optional<int> asked_decimals) {
  const int decimals = asked_decimals.value_or(fitting_decimals(take));
  std::string text = take.skeleton->source_text;
  const std::string end = line_end_of(text);
  if (!text.empty() && text.back() != '\n' && text.back() != '\r') text += end;
  text += "MOTION" + end + "Frames: " + std::to_string(take.frames()) + end;
  text += "Frame Time: " + take.layout.frame_time_text + end;
  text.reserve(text.size() + static_cast<std::size_t>(take.channels.size()) * 12);
  for (long f = 0; f < take.frames(); ++f) {
    for (Eigen::Index c = 0; c < take.channels.cols(); ++c) {
      if (c > 0) text += ' ';
      append_value(text, take.channels(f, c), decimals);
    }
    text += end;
  }
  return text;
}

std::string write_amc(const Take& take, std::optional<int> asked_decimals) {
  const int decimals = asked_decimals.value_or(fitting_decimals(take));
  const TakeLayout& layout = take.layout;
  std::string text = layout.amc_header;
  const std::string end = line_end_of(text);
  if (!text.empty() && text.back() != '\n' && text.back() != '\r') text += end;
  text.reserve(text.size() + static_cast<std::size_t>(take.channels.size()) * 16);
  const double scale = layout.radians ? radians_per_degree : 1.0;
  for (long f = 0; f < take.frames(); ++f) {
    text += std::to_string(layout.first_frame_number + f) + end;
    for (const int j : layout.amc_joints) {
      const Joint& joint = take.skeleton->joints[j];
      text += joint.name;
      for (std::size_t c = 0; c < joint.channels.size(); ++c) {
        const double value = take.channels(f, joint.first_channel + static_cast<Eigen::Index>(c));
        text += ' ';
        append_value(text, is_rotation(joint.channels[c]) ? value * scale : value, decimals);
      }
      text += end;
    }
  }
  return text;
}

std::string write_motion(const Take& take, std::optional<int> decimals) {
  return take.skeleton->format == MotionFormat::bvh ? write_bvh(take, decimals)
                                                    : write_amc(take, decimals);
}

}  // namespace reprise
