#include "formats/text_lines.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v'; }

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }

/// A whole word as any finite number.
std::optional<double> finite_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = fast_float::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

}  // namespace

bool TextLines::next(std::string_view& line) {
  if (position_ >= text_.size()) return false;
  line_start_ = position_;
  const std::size_t end = text_.find_first_of("\r\n", position_);
  line = text_.substr(position_, end == std::string_view::npos ? end : end - position_);
  ++number_;
  position_ = end == std::string_view::npos ? text_.size() : end + 1;
  if (end != std::string_view::npos && text_[end] == '\r' && position_ < text_.size() &&
      text_[position_] == '\n') {
    ++position_;
  }
  if (line.size() > InputLimits::line_bytes) {
    reject("a line is longer than " + std::to_string(InputLimits::line_bytes) + " bytes");
  }
  if (line.find('\0') != std::string_view::npos)
    reject("there is a NUL byte; this is not a text file");
  return true;
}

void TextLines::reject(const std::string& why, const std::string& advice) const {
  throw Error(ErrorCode::rejected_input, why, {file_, std::max<std::size_t>(number_, 1)}, advice);
}

std::string_view next_word(std::string_view& line) {
  std::size_t start = 0;
  while (start < line.size() && is_blank(line[start])) ++start;
  std::size_t end = start;
  while (end < line.size() && !is_blank(line[end])) ++end;
  const std::string_view word = line.substr(start, end - start);
  line.remove_prefix(end);
  return word;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return lower(x) == lower(y); });
}

std::optional<double> to_number(std::string_view word) {
  if (word.size() > InputLimits::number_bytes) return std::nullopt;
  const std::optional<double> value = finite_number(word);
  return value && std::abs(*value) <= InputLimits::magnitude ? value : std::nullopt;
}

std::string why_no_number(std::string_view word) {
  if (word.empty()) return "a number is missing";
  if (word.size() > InputLimits::number_bytes) {
    return "a number is longer than " + std::to_string(InputLimits::number_bytes) +
           " bytes: " + in_quotes(word);
  }
  if (finite_number(word)) {
    return "a number is beyond " + std::to_string(InputLimits::magnitude) + ": " + in_quotes(word);
  }
  return "this is not a number: " + in_quotes(word);
}

std::optional<long> to_count(std::string_view word) {
  long value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value < 0) return std::nullopt;
  return value;
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t most = 40;
  std::string text = "'";
  for (const char c : word.substr(0, most)) text += static_cast<unsigned char>(c) < 32 ? '?' : c;
  return text + (word.size() > most ? "...'" : "'");
}

}  // namespace reprise
