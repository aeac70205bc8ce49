#include "exact/decimal.h"

#include <algorithm>
#include <bit>

namespace reprise {
namespace {

constexpr auto make_pairs() {
  std::array<char, 200> pairs{};
  for (int i = 0; i < 100; ++i) {
    pairs[2 * i] = static_cast<char>('0' + i / 10);
    pairs[2 * i + 1] = static_cast<char>('0' + i % 10);
  }
  return pairs;
}
constexpr auto pairs = make_pairs();

}  // namespace

std::optional<Decimal> take_apart(std::string_view word) {
  Decimal decimal;
  std::size_t i = 0;
  if (i < word.size() && word[i] == '-') decimal.negative = true, ++i;
  int digits = 0;
  bool point = false;
  for (; i < word.size() && (is_digit(word[i]) || (word[i] == '.' && !point)); ++i) {
    if (word[i] == '.') {
      point = true;
      continue;
    }
    if (decimal.digits != 0 || word[i] != '0') {
      if (++digits > most_digits) return std::nullopt;
    }
    decimal.digits = decimal.digits * 10 + static_cast<unsigned>(word[i] - '0');
    decimal.decimals += point;
  }
  if (i < word.size()) {
    if (word[i] != 'e' || word.size() - i > 6) return std::nullopt;
    bool negative = false;
    int exponent = 0;
    for (++i; i < word.size(); ++i) {
      if (is_digit(word[i])) {
        exponent = exponent * 10 + (word[i] - '0');
      } else if (word[i] == '-') {
        negative = true;
      } else if (word[i] != '+') {
        return std::nullopt;
      }
    }
    decimal.exponent = negative ? -exponent : exponent;
  }
  decimal.exponent -= decimal.decimals;
  return decimal;
}

int count_digits(std::uint64_t value) {
  int digits = static_cast<int>(std::bit_width(value | 1)) * 1233 >> 12;
  if (digits <= most_digits && value >= powers_of_ten[digits]) ++digits;
  return std::max(digits, 1);
}

void append_digits(std::uint64_t value, int width, std::string& text) {
  std::array<char, 24> buffer;
  auto* const end = buffer.data() + buffer.size();
  char* begin = end;
  while (value >= 10) {
    const char* const pair = &pairs[2 * (value % 100)];
    value /= 100;
    *--begin = pair[1];
    *--begin = pair[0];
  }
  if (value != 0) *--begin = static_cast<char>('0' + value);
  while (end - begin < width) *--begin = '0';
  text.append(begin, end);
}

}  // namespace reprise
