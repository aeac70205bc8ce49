// The text of a motion file apart from its numbers: what comes before the frames, the frame that
// all frames look like, and the frames that do not.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace reprise {

/// Stand for a number in a pattern and end each string that is kept beside the numbers; texts
/// that hold these bytes themselves have no layout.
constexpr char number_mark = '\1';
constexpr char string_end = '\0';

/// Frames are pieces of text one after another: the lines after a BVH's frame time, or what goes
/// from one AMC frame number to the next.
struct TextLayout {
  std::string_view header;  ///< all before the first frame
  std::string pattern;      ///< what most frames look like: number_mark for each number
  std::size_t slots = 0;    ///< numbers of such a frame
  struct Frame {
    std::string_view text;
    bool odd = false;  ///< does not look like the pattern
  };
  std::vector<Frame> frames;
  std::size_t cut = 0;  ///< how many bytes of the pattern the last frame lacks at its end
  /// The numbers of all frames that are not odd, frame by frame.
  std::vector<std::string_view> numbers;
};

/// A layout without frames where the text has none, or holds one of the marks.
TextLayout read_layout(std::string_view text);

/// The pieces between the numbers of a pattern, one more than it has numbers.
std::vector<std::string_view> pieces_of(std::string_view pattern);

}  // namespace reprise
