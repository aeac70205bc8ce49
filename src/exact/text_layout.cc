#include "exact/text_layout.h"

#include <algorithm>
#include <map>

#include "exact/number_format.h"

namespace reprise {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// A line with its end: LF, CR or CR LF.
std::string_view next_line(std::string_view& rest) {
  std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
  if (end < rest.size()) end += rest.substr(end).starts_with("\r\n") ? 2 : 1;
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end);
  return line;
}

/// Calls `space(text)` and `word(text)` for each run of spaces and of other characters.
template <class Space, class Word>
void split(std::string_view text, Space&& space, Word&& word) {
  std::size_t i = 0;
  while (i < text.size()) {
    const std::size_t begin = i;
    const bool blank = is_space(text[i]);
    while (i < text.size() && is_space(text[i]) == blank) ++i;
    if (blank) {
      space(text.substr(begin, i - begin));
    } else {
      word(text.substr(begin, i - begin));
    }
  }
}

std::string pattern_of(std::string_view text) {
  std::string pattern;
  split(
      text, [&](std::string_view space) { pattern.append(space); },
      [&](std::string_view word) {
        if (is_number(word)) {
          pattern.push_back(number_mark);
        } else {
          pattern.append(word);
        }
      });
  return pattern;
}

bool starts_with_frame_time(std::string_view line) {
  constexpr std::string_view wanted = "frametime";
  std::size_t matched = 0;
  for (const char c : line) {
    if (c == ' ' || c == '\t') continue;
    const char lower = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    if (lower != wanted[matched]) return false;
    if (++matched == wanted.size()) return true;
  }
  return false;
}

/// A line that is one whole number and nothing else.
bool is_frame_number(std::string_view line) {
  while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
  while (!line.empty() && is_space(line.front())) line.remove_prefix(1);
  return !line.empty() && line.find_first_not_of("0123456789") == std::string_view::npos;
}

/// Cuts the text into frames; all before the first one is the header.
void cut_into_frames(std::string_view text, TextLayout& layout) {
  std::string_view rest = text;
  std::size_t first_number = std::string_view::npos;
  while (!rest.empty()) {
    const std::size_t start = text.size() - rest.size();
    const std::string_view line = next_line(rest);
    if (starts_with_frame_time(line)) {
      layout.header = text.substr(0, text.size() - rest.size());
      while (!rest.empty()) layout.frames.push_back({next_line(rest)});
      return;
    }
    if (first_number == std::string_view::npos && is_frame_number(line)) first_number = start;
  }
  if (first_number == std::string_view::npos) return;
  layout.header = text.substr(0, first_number);
  rest = text.substr(first_number);
  std::size_t frame_start = first_number;
  while (!rest.empty()) {
    const std::size_t start = text.size() - rest.size();
    if (is_frame_number(next_line(rest)) && start > frame_start) {
      layout.frames.push_back({text.substr(frame_start, start - frame_start)});
      frame_start = start;
    }
  }
  layout.frames.push_back({text.substr(frame_start)});
}

/// What most of the first frames look like.
std::string usual_pattern(const std::vector<TextLayout::Frame>& frames) {
  constexpr std::size_t looked_at = 32;
  std::map<std::string, int> counts;
  for (std::size_t f = 0; f < std::min(frames.size(), looked_at); ++f) {
    ++counts[pattern_of(frames[f].text)];
  }
  return std::max_element(counts.begin(), counts.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// Puts a frame's numbers at the end of `numbers` if it looks like the pattern, or like its start
/// with all of its numbers where `cut` is given.
bool match(std::string_view frame, const TextLayout& layout, std::size_t* cut,
           std::vector<std::string_view>& numbers) {
  std::string_view pattern = layout.pattern;
  const std::size_t before = numbers.size();
  bool same = true;
  const auto literal = [&](std::string_view text) {
    same = same && pattern.starts_with(text);
    if (same) pattern.remove_prefix(text.size());
  };
  split(frame, literal, [&](std::string_view word) {
    if (!is_number(word)) return literal(word);
    same = same && pattern.starts_with(number_mark);
    if (!same) return;
    pattern.remove_prefix(1);
    numbers.push_back(word);
  });
  same = same && numbers.size() - before == layout.slots;
  if (same && cut != nullptr) *cut = pattern.size();
  if (same && (pattern.empty() || cut != nullptr)) return true;
  numbers.resize(before);
  return false;
}

}  // namespace

TextLayout read_layout(std::string_view text) {
  TextLayout layout;
  if (text.find(number_mark) != std::string_view::npos) return layout;
  if (text.find(string_end) != std::string_view::npos) return layout;
  cut_into_frames(text, layout);
  if (layout.frames.empty()) return layout;
  layout.pattern = usual_pattern(layout.frames);
  layout.slots = static_cast<std::size_t>(
      std::count(layout.pattern.begin(), layout.pattern.end(), number_mark));
  for (std::size_t f = 0; f < layout.frames.size(); ++f) {
    const bool last = f + 1 == layout.frames.size();
    layout.frames[f].odd =
        !match(layout.frames[f].text, layout, last ? &layout.cut : nullptr, layout.numbers);
  }
  return layout;
}

std::vector<std::string_view> pieces_of(std::string_view pattern) {
  std::vector<std::string_view> pieces;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= pattern.size(); ++i) {
    if (i < pattern.size() && pattern[i] != number_mark) continue;
    pieces.push_back(pattern.substr(begin, i - begin));
    begin = i + 1;
  }
  return pieces;
}

}  // namespace reprise
