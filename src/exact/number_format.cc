#include "exact/number_format.h"

#include <algorithm>

#include "exact/decimal.h"

namespace reprise {
namespace {

std::uint64_t decade_size_of(const NumberFormat& format) {
  return 9 * powers_of_ten[format.digits - 1];
}

}  // namespace

bool is_number(std::string_view word) {
  std::size_t i = !word.empty() && (word[0] == '-' || word[0] == '+') ? 1 : 0;
  int digits = 0, points = 0;
  for (; i < word.size() && (is_digit(word[i]) || word[i] == '.'); ++i) {
    ++(word[i] == '.' ? points : digits);
  }
  if (digits == 0 || points > 1) return false;
  if (i == word.size()) return true;
  if (word[i] != 'e' && word[i] != 'E') return false;
  if (++i < word.size() && (word[i] == '-' || word[i] == '+')) ++i;
  return i < word.size() && std::all_of(word.begin() + i, word.end(), is_digit);
}

std::int64_t approximate_value(std::string_view word, int decimals) {
  if (!is_number(word)) return 0;
  const auto decimal = take_apart(word);
  if (!decimal) return 0;
  std::uint64_t magnitude = decimal->digits;
  for (int e = std::clamp(decimal->exponent + decimals, -20, 20); e != 0; e += e < 0 ? 1 : -1) {
    magnitude = e < 0 ? magnitude / 10 : magnitude * 10;
    if (magnitude >= static_cast<std::uint64_t>(NumberGrid::most_magnitude) && e > 0) return 0;
  }
  if (magnitude >= static_cast<std::uint64_t>(NumberGrid::most_magnitude)) return 0;
  const auto wide = static_cast<std::int64_t>(magnitude);
  return decimal->negative ? -wide : wide;
}

NumberPrinter::NumberPrinter(const NumberFormat& format)
    : format_(format),
      // Of numbers with more digits than a magnitude has, `fine` holds the rest at any magnitude.
      grid_(format.style == NumberStyle::fixed          ? format.grid
            : format.digits > NumberGrid::most_decimals ? GridKind::linear
                                                        : GridKind::significant,
            format.decimals, std::min<int>(format.digits, NumberGrid::most_decimals)),
      decade_size_(decade_size_of(format)) {}

int NumberPrinter::fine_digits(std::int64_t magnitude) const {
  if (format_.style == NumberStyle::fixed) return 0;
  if (magnitude <= 1) return format_.digits;
  return std::max(0, format_.digits - count_digits(static_cast<std::uint64_t>(magnitude - 1)));
}

std::optional<CodedNumber> NumberPrinter::parse(std::string_view word) const {
  const auto decimal = take_apart(word);
  if (!decimal) return std::nullopt;
  CodedNumber number;
  std::uint64_t magnitude = decimal->digits;
  if (format_.style == NumberStyle::fixed) {
    if (decimal->decimals != format_.decimals) return std::nullopt;
  } else if (decimal->digits == 0) {
    magnitude = 0;
  } else {
    const int count = count_digits(decimal->digits);
    if (count > format_.digits) return std::nullopt;
    const std::uint64_t digits = decimal->digits * powers_of_ten[format_.digits - count];
    const int in_units = decimal->exponent - (format_.digits - count) + format_.decimals;
    if (in_units >= 0) {
      if (in_units + format_.digits > most_digits) return std::nullopt;
      magnitude = digits * powers_of_ten[in_units];
      // Of a power of ten, those below it are finer.
      const int fine = fine_digits(static_cast<std::int64_t>(
          std::min<std::uint64_t>(magnitude, NumberGrid::most_magnitude)));
      if (fine > 0) number.fine = powers_of_ten[fine] / 2;
    } else {
      const int finer = -in_units;
      magnitude =
          finer > format_.digits ? 0 : (digits + powers_of_ten[finer] / 2) / powers_of_ten[finer];
      if (magnitude == 0) {
        const int decade = finer - format_.digits;
        if (decade >= tiny_decades) return std::nullopt;
        number.fine = 1 + static_cast<unsigned>(decade) * decade_size_ +
                      (digits - powers_of_ten[format_.digits - 1]);
      } else {
        const int fine = fine_digits(static_cast<std::int64_t>(magnitude));
        // The smallest of a decade may be next to a larger one's multiple of the unit.
        if (fine != finer && fine != finer + 1) return std::nullopt;
        number.fine = digits * powers_of_ten[fine - finer] + powers_of_ten[fine] / 2 -
                      magnitude * powers_of_ten[fine];
      }
    }
  }
  if (magnitude >= static_cast<std::uint64_t>(NumberGrid::most_magnitude)) return std::nullopt;
  const auto wide = static_cast<std::int64_t>(magnitude);
  number.index = grid_.index_of(wide);
  if (decimal->negative) number.index = ~number.index;
  std::string again;
  print(number, again);
  if (again != word) return std::nullopt;
  return number;
}

void NumberPrinter::print(const CodedNumber& number, std::string& text) const {
  const bool negative = number.index < 0;
  const auto magnitude = static_cast<std::uint64_t>(magnitude_of(grid_, number.index));
  if (format_.style == NumberStyle::fixed) {
    if (negative) text.push_back('-');
    const std::uint64_t one = powers_of_ten[format_.decimals];
    append_digits(magnitude / one, 1, text);
    if (format_.decimals == 0) return;
    text.push_back('.');
    append_digits(magnitude % one, format_.decimals, text);
    return;
  }
  if (magnitude == 0) {
    if (number.fine == 0) return text.append(negative ? "-0" : "0"), void();
    const std::uint64_t rest = number.fine - 1;
    const auto decade = static_cast<int>(std::min<std::uint64_t>(rest / decade_size_, 99));
    return print_general(negative, powers_of_ten[format_.digits - 1] + rest % decade_size_,
                         -decade - 1 - format_.decimals, text);
  }
  const int fine = fine_digits(static_cast<std::int64_t>(magnitude));
  std::uint64_t digits = magnitude;
  int exponent = -format_.decimals;
  if (fine > 0) {
    digits = magnitude * powers_of_ten[fine] - powers_of_ten[fine] / 2 + number.fine;
    exponent -= fine;
  }
  const int count = count_digits(digits);
  if (count < format_.digits) {
    digits *= powers_of_ten[format_.digits - count];
  } else if (count > format_.digits) {
    digits /= powers_of_ten[count - format_.digits];
  }
  print_general(negative, digits, exponent + count - 1, text);
}

void NumberPrinter::print_general(bool negative, std::uint64_t digits, int exponent,
                                  std::string& text) const {
  if (negative) text.push_back('-');
  int count = format_.digits;
  while (count > 1 && digits % 10 == 0) digits /= 10, --count;
  if (exponent >= -4 && exponent < format_.digits) {
    const int decimals = count - 1 - exponent;
    if (decimals <= 0) {
      append_digits(digits * powers_of_ten[-decimals], 1, text);
    } else {
      append_digits(digits / powers_of_ten[std::min(decimals, most_digits)], 1, text);
      text.push_back('.');
      append_digits(digits % powers_of_ten[std::min(decimals, most_digits)], decimals, text);
    }
    return;
  }
  append_digits(digits / powers_of_ten[count - 1], 1, text);
  if (count > 1) {
    text.push_back('.');
    append_digits(digits % powers_of_ten[count - 1], count - 1, text);
  }
  text.append(exponent < 0 ? "e-" : "e+");
  append_digits(static_cast<unsigned>(exponent < 0 ? -exponent : exponent), format_.exponent_digits,
                text);
}

}  // namespace reprise
