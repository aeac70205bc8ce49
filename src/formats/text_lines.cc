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

bool has_decimal_comma(std::string_view word) {
  std::string pointed(word);
  std::ranges::replace(pointed, ',', '.');
  return std::ranges::count(word, ',') == 1 && !word.ends_with(',') && finite_number(pointed);
}

/// Whether a word is numbers with commas after or between them.
bool is_parted_by_commas(std::string_view word) {
  if (word.find(',') == std::string_view::npos) return false;
  while (!word.empty()) {
    const std::size_t end = std::min(word.find(','), word.size());
    if (!finite_number(word.substr(0, end))) return false;
    word.remove_prefix(std::min(end + 1, word.size()));
  }
  return true;
}

/// Whether a word is one number right behind another: 1.5-2.3, 12.345.678 or 0.5+1.
bool is_glued(std::string_view word) {
  for (std::size_t at = 1; at < word.size(); ++at) {
    const bool starts = word[at] == '-' || word[at] == '+' || word[at] == '.';
    if (!starts || !finite_number(word.substr(0, at))) continue;
    const std::string_view rest = word.substr(at);
    if (finite_number(rest) || is_glued(rest)) return true;
  }
  return false;
}

}  // namespace

bool TextLines::next(std::string_view& line) {
  if (position_ >= text_.size()) return false;
  line_start_ = position_;
  const std::size_t end = text_.find_first_of("\r\n", position_);
  line = text_.substr(position_, end == std::string_view::npos ? end : end - position_);
  ++number_;
  ended_ = end != std::string_view::npos;
  position_ = ended_ ? end + 1 : text_.size();
  if (ended_ && text_[end] == '\r' && position_ < text_.size() && text_[position_] == '\n') {
    ++position_;
  }
  if (line.size() > InputLimits::line_bytes) {
    reject("a line is longer than " + std::to_string(InputLimits::line_bytes) + " bytes");
  }
  if (line.find('\0') != std::string_view::npos)
    reject("there is a NUL byte; this is not a text file");
  return true;
}

bool TextLines::nothing_follows() const {
  return std::ranges::all_of(text_.substr(position_),
                             [](char c) { return is_blank(c) || c == '\r' || c == '\n'; });
}

void TextLines::reject(const std::string& why, const std::string& advice) const {
  throw Error(ErrorCode::rejected_input, why, {file_, std::max<std::size_t>(number_, 1)},
              advice.empty() ? "mend the file there, or export it again" : advice);
}

void TextLines::reject_number(std::string_view word, const std::string& where) const {
  const NumberFault fault = number_fault(word);
  reject(where + fault.why, fault.advice);
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

NumberFault number_fault(std::string_view word) {
  if (word.empty()) return {"a number is missing", {}};
  if (word.size() > InputLimits::number_bytes) {
    return {"a number is longer than " + std::to_string(InputLimits::number_bytes) +
                " bytes: " + in_quotes(word),
            {}};
  }
  if (finite_number(word)) {
    return {"a number is beyond " + std::to_string(InputLimits::magnitude) + ": " + in_quotes(word),
            "nobody is so far away: look for a fault of the recording there"};
  }
  if (has_decimal_comma(word)) {
    return {"a decimal comma stands where a point should: " + in_quotes(word),
            "export it with decimal points, as an English system does"};
  }
  if (is_parted_by_commas(word)) {
    return {"numbers are parted by commas: " + in_quotes(word), "part them by spaces"};
  }
  if (is_glued(word)) {
    return {"two numbers stand together without a space: " + in_quotes(word),
            "put a space between them, or export it with wider columns"};
  }
  return {"this is not a number: " + in_quotes(word), {}};
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
