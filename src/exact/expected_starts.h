// What a BVH's hierarchy says of the numbers of its frames: position channels mostly stay where
// the joint's OFFSET is.
#pragma once

#include <string_view>
#include <vector>

namespace reprise {

/// Of each channel, in the order of the frames' numbers: the word of the offset along its axis, or
/// "0" for other channels. Any text is read; one that says nothing gives fewer words.
std::vector<std::string_view> expected_starts(std::string_view hierarchy);

}  // namespace reprise
