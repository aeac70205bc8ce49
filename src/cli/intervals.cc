#include "cli/intervals.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>

#include "cli/option_values.h"
#include "reprise/error.h"

namespace reprise::cli {
namespace {

/// Beyond this no time makes sense; it also keeps products of times and rates in range.
constexpr double greatest_time = 1e9;
/// Part of a frame by which a time given in decimals may miss its frame.
constexpr double frame_tolerance = 1e-6;

template <typename T>
Interval<T> parse_interval(std::string_view option, std::string_view text, T most) {
  constexpr std::string_view wanted = "an interval A:B with A before B, such as 0:2, 3: or :5";
  const auto colon = text.find(':');
  if (colon == std::string_view::npos) refuse_value(option, text, wanted);
  const auto side = [&](std::string_view part) -> std::optional<T> {
    if (part.empty()) return std::nullopt;
    const auto value = read_all<T>(part);
    // A NaN fails both comparisons.
    if (!value || !(*value >= 0 && *value <= most)) refuse_value(option, text, wanted);
    return value;
  };
  const Interval<T> interval{side(text.substr(0, colon)), side(text.substr(colon + 1))};
  if (!interval.begin && !interval.end) refuse_value(option, text, wanted);
  if (interval.end && interval.begin.value_or(0) >= *interval.end)
    refuse_value(option, text, wanted);
  return interval;
}

long first_frame_from(double seconds, double frame_rate) {
  return static_cast<long>(std::ceil(seconds * frame_rate - frame_tolerance));
}

}  // namespace

Interval<long> parse_frame_interval(std::string_view option, std::string_view text) {
  return parse_interval<long>(option, text, std::numeric_limits<long>::max());
}

Interval<double> parse_time_interval(std::string_view option, std::string_view text) {
  return parse_interval<double>(option, text, greatest_time);
}

FrameRange frames_of(const Interval<long>& interval, FrameRange whole) {
  const FrameRange range{interval.begin.value_or(whole.begin), interval.end.value_or(whole.end)};
  if (range.begin < whole.begin || range.end > whole.end || range.begin >= range.end) {
    throw Error(ErrorCode::usage,
                fmt::format("frames {}:{} are not within {}:{}, which is what there is",
                            interval.begin ? std::to_string(range.begin) : "",
                            interval.end ? std::to_string(range.end) : "", whole.begin, whole.end));
  }
  return range;
}

FrameRange frames_of(const Interval<double>& interval, FrameRange whole, double frame_rate) {
  const auto side = [&](const std::optional<double>& seconds, long otherwise) {
    return seconds ? first_frame_from(*seconds, frame_rate) : otherwise;
  };
  const FrameRange range{side(interval.begin, whole.begin), side(interval.end, whole.end)};
  const auto text = [](const std::optional<double>& seconds) {
    return seconds ? fmt::format("{:g}", *seconds) : std::string();
  };
  const std::string asked = fmt::format("{}:{} s", text(interval.begin), text(interval.end));
  if (range.begin < whole.begin || range.begin >= whole.end || range.end > whole.end) {
    throw Error(ErrorCode::usage,
                fmt::format("{} are not within {:g}:{:g} s, which is what there is", asked,
                            static_cast<double>(whole.begin) / frame_rate,
                            static_cast<double>(whole.end) / frame_rate));
  }
  if (range.begin >= range.end) {
    throw Error(ErrorCode::usage,
                fmt::format("no frame is within {}: there are {:g} a second", asked, frame_rate));
  }
  return range;
}

}  // namespace reprise::cli
