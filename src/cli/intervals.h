// Parts of a take as options say them: in frames or in seconds.
#pragma once

#include <optional>
#include <string_view>

#include "reprise/archive.h"

namespace reprise::cli {

/// A half-open interval "A:B", "A:" or ":B".
template <typename T>
struct Interval {
  std::optional<T> begin;
  std::optional<T> end;
};

/// Throw Error (usage) where the text is no interval or holds nothing.
Interval<long> parse_frame_interval(std::string_view option, std::string_view text);
Interval<double> parse_time_interval(std::string_view option, std::string_view text);

/// The frames in the interval, or those whose times at `frame_rate` are in it. Sides that are
/// left out are those of `whole`. Throws Error (usage) where the result is empty or goes beyond
/// `whole`.
FrameRange frames_of(const Interval<long>& interval, FrameRange whole);
FrameRange frames_of(const Interval<double>& interval, FrameRange whole, double frame_rate);

}  // namespace reprise::cli
