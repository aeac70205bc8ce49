// How a motion file writes its numbers: text to integers, and back to the same text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "exact/number_grid.h"

namespace reprise {

/// What printf calls %.6f (fixed) and %.6g (general); general numbers may have an exponent.
enum class NumberStyle : std::uint8_t { fixed = 0, general = 1 };

struct NumberFormat {
  NumberStyle style = NumberStyle::fixed;
  GridKind grid = GridKind::linear;  ///< of general numbers always `significant`
  std::uint8_t decimals = 6;         ///< written by `fixed`; the unit is 10^-decimals
  std::uint8_t digits = 6;           ///< significant digits, where the grid or style has them
  std::uint8_t exponent_digits = 2;  ///< the least that `general` writes: 2, or 3 on some systems

  bool operator==(const NumberFormat&) const = default;
};

/// A number on its grid. `index` is that of the magnitude; of negative numbers, and -0, its
/// complement. Of general numbers below 10^(digits - 1) units, `fine` says which of those next to
/// the magnitude is meant: 0 to 10^fine_digits - 1; next to zero it is 0 for zero itself, else
/// 1 + decade x 9 x 10^(digits - 1) + the digits after the first one's least, decades counted
/// downwards.
struct CodedNumber {
  std::int64_t index = 0;
  std::uint64_t fine = 0;

  bool operator==(const CodedNumber&) const = default;
};

/// Turns numbers of one format into integers and back.
class NumberPrinter {
 public:
  explicit NumberPrinter(const NumberFormat& format);

  const NumberFormat& format() const { return format_; }
  const NumberGrid& grid() const { return grid_; }

  /// Nothing, unless `print` gives the same text again.
  std::optional<CodedNumber> parse(std::string_view word) const;
  /// Appends the text of a number. Numbers that `parse` never gives have some text, too.
  void print(const CodedNumber& number, std::string& text) const;

  /// How many decimal digits `fine` has at this magnitude.
  int fine_digits(std::int64_t magnitude) const;
  /// Decades below the unit that `fine` can tell apart next to zero.
  static constexpr int tiny_decades = 64;
  /// How many numbers a decade has.
  std::uint64_t decade_size() const { return decade_size_; }

 private:
  void print_general(bool negative, std::uint64_t digits, int exponent, std::string& text) const;

  NumberFormat format_;
  NumberGrid grid_;
  std::uint64_t decade_size_ = 0;
};

/// Whether a word is a number at all: digits with at most one point and one exponent.
bool is_number(std::string_view word);

/// A word in units of 10^-decimals, rounded towards zero; 0 for what is no number, or too large.
std::int64_t approximate_value(std::string_view word, int decimals);

/// A signed value from an index, and the way back (to the nearest number of the grid).
inline std::int64_t magnitude_of(const NumberGrid& grid, std::int64_t index) {
  return grid.magnitude_of(index < 0 ? ~index : index);
}
inline std::int64_t value_of(const NumberGrid& grid, std::int64_t index) {
  return index < 0 ? -grid.magnitude_of(~index) : grid.magnitude_of(index);
}
inline std::int64_t index_of(const NumberGrid& grid, std::int64_t value) {
  return value < 0 ? ~grid.index_of(-value) : grid.index_of(value);
}

}  // namespace reprise
