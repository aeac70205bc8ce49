#include "exact/expected_starts.h"

#include <array>

namespace reprise {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

std::string_view next_word(std::string_view& rest) {
  std::size_t begin = 0;
  while (begin < rest.size() && is_space(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !is_space(rest[end])) ++end;
  const std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return word;
}

}  // namespace

std::vector<std::string_view> expected_starts(std::string_view hierarchy) {
  std::vector<std::string_view> starts;
  std::array<std::string_view, 3> offset = {"0", "0", "0"};
  while (!hierarchy.empty()) {
    const std::string_view word = next_word(hierarchy);
    if (word == "OFFSET") {
      for (auto& part : offset) part = next_word(hierarchy);
    } else if (word.ends_with("position") && word[0] >= 'X' && word[0] <= 'Z') {
      starts.push_back(offset[static_cast<std::size_t>(word[0] - 'X')]);
    } else if (word.ends_with("rotation")) {
      starts.push_back("0");
    }
  }
  return starts;
}

}  // namespace reprise
