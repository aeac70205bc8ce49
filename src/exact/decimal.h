// Decimal numbers as digits: a word taken apart, digits written.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace reprise {

/// Digits that 64 bits hold for certain.
constexpr int most_digits = 18;

constexpr auto powers_of_ten = [] {
  std::array<std::uint64_t, most_digits + 1> powers{};
  std::uint64_t power = 1;
  for (auto& entry : powers) entry = power, power *= 10;
  return powers;
}();

/// A word taken apart: digits x 10^exponent, `decimals` of the digits behind the point.
struct Decimal {
  bool negative = false;
  std::uint64_t digits = 0;
  int exponent = 0;
  int decimals = 0;
};

/// None where a word is not made of what numbers are made of, or has more than `most_digits`
/// digits. Takes more than numbers (is_number): whoever needs the word back has to compare.
std::optional<Decimal> take_apart(std::string_view word);

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// How many digits a number has; 0 has one.
int count_digits(std::uint64_t value);

/// Appends at least `width` digits (at most 20), with zeros in front.
void append_digits(std::uint64_t value, int width, std::string& text);

}  // namespace reprise
