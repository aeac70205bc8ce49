// Text in lines and words, with line numbers for errors.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reprise/error.h"

namespace reprise {

/// Goes through a text line by line; lines end in LF, CRLF or CR.
class TextLines {
 public:
  /// A byte order mark of UTF-8 at the front is passed over.
  TextLines(std::string_view text, std::string file)
      : text_(text), file_(std::move(file)), position_(text.starts_with("\xEF\xBB\xBF") ? 3 : 0) {}

  /// The next line without its end, or false at the end of the text.
  bool next(std::string_view& line);
  /// Number of the line that `next` gave last, from 1 on.
  std::size_t number() const { return number_; }
  /// Offset of the first byte after that line and its end.
  std::size_t position() const { return position_; }
  /// Offset of that line's first byte.
  std::size_t line_start() const { return line_start_; }
  const std::string& file() const { return file_; }

  /// Whether nothing but blanks comes after that line.
  bool nothing_follows() const;
  /// Whether the text ends within that line.
  bool unfinished() const { return position_ == text_.size() && !ended_; }

  /// Throws Error (rejected_input) with the file and line. Without advice there is a general one.
  [[noreturn]] void reject(const std::string& why, const std::string& advice = {}) const;
  /// The same for a word that is no number (to_number); `where` stands before the sentence.
  [[noreturn]] void reject_number(std::string_view word, const std::string& where = {}) const;

 private:
  std::string_view text_;
  std::string file_;
  std::size_t position_, line_start_ = 0;
  std::size_t number_ = 0;
  bool ended_ = true;
};

/// Takes the next word off the front of `line`; empty at its end. Words are parted by spaces and
/// tabs.
std::string_view next_word(std::string_view& line);
std::string_view trimmed(std::string_view text);
bool equal_ignoring_case(std::string_view a, std::string_view b);

/// A whole word as a number within the limits: decimal, with or without exponent. None for anything
/// else.
std::optional<double> to_number(std::string_view word);
/// A whole word as a count.
std::optional<long> to_count(std::string_view word);

/// Why `to_number` did not take a word, as a sentence that quotes it, and what to do.
struct NumberFault {
  std::string why;
  std::string advice;
};
NumberFault number_fault(std::string_view word);

/// A word for an error message: in quotes, cut where it is long, without control characters.
std::string in_quotes(std::string_view word);

}  // namespace reprise
