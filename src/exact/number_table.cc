#include "exact/number_table.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "exact/column_references.h"

namespace reprise {
namespace {

/// How many numbers of a hundred thousand may miss a narrower grid.
constexpr std::size_t most_misses = 1000;

/// What the words of one column have in common.
struct Shape {
  std::array<std::size_t, 19> decimals{};  ///< words by their decimals; without a point: 0
  std::size_t exponents = 0, long_exponents = 0;
  int digits = 1;  ///< the most significant digits

  void add(std::string_view word) {
    const std::size_t exponent = word.find('e');
    if (exponent != std::string_view::npos) {
      ++exponents;
      long_exponents += word.size() - exponent == 5;
      word = word.substr(0, exponent);
    }
    const std::size_t point = word.find('.');
    const std::size_t count = point == std::string_view::npos ? 0 : word.size() - point - 1;
    ++decimals[std::min<std::size_t>(count, decimals.size() - 1)];
    int significant = 0;
    for (const char c : word) significant += c >= (significant == 0 ? '1' : '0') && c <= '9';
    digits = std::max(digits, significant);
  }
};

NumberFormat format_of(const Shape& shape, int digits) {
  NumberFormat format;
  const auto most = std::max_element(shape.decimals.begin(), shape.decimals.end());
  std::size_t words = 0;
  for (const std::size_t count : shape.decimals) words += count;
  const auto decimals = static_cast<std::uint8_t>(most - shape.decimals.begin());
  format.digits = 9;
  if (shape.exponents == 0 && *most * 20 >= words * 19 && decimals <= NumberGrid::most_decimals) {
    format.decimals = decimals;
    return format;
  }
  format.style = NumberStyle::general;
  format.grid = GridKind::significant;
  format.digits = static_cast<std::uint8_t>(std::clamp(digits, 1, 17));
  format.decimals = std::min<std::uint8_t>(format.digits, NumberGrid::most_decimals);
  format.exponent_digits = shape.long_exponents * 2 > shape.exponents ? 3 : 2;
  return format;
}

using Columns = std::vector<std::size_t>;

/// Whether all but a few words of these columns are on the format's grid.
bool fits(const NumberFormat& format, const std::vector<std::string_view>& words,
          std::size_t columns, const Columns& chosen) {
  const NumberPrinter printer(format);
  std::size_t misses = 0, seen = 0;
  for (std::size_t row = 0; row < words.size(); row += columns) {
    for (const std::size_t c : chosen) misses += !printer.parse(words[row + c]), ++seen;
    if (misses * 100 > most_misses + seen) return false;
  }
  return misses * 100'000 <= most_misses * seen;
}

/// The narrowest grid that holds the numbers of columns with one fixed format.
NumberFormat narrowed(NumberFormat format, const std::vector<std::string_view>& words,
                      std::size_t columns, const Columns& chosen) {
  if (format.style != NumberStyle::fixed || format.decimals < 3) return format;
  NumberFormat narrow = format;
  narrow.grid = GridKind::significant;
  for (int digits = 5; digits <= 8; ++digits) {
    narrow.digits = static_cast<std::uint8_t>(digits);
    if (fits(narrow, words, columns, chosen)) return narrow;
  }
  narrow = format;
  narrow.grid = GridKind::single;
  return fits(narrow, words, columns, chosen) ? narrow : format;
}

void find_formats(const std::vector<std::string_view>& words, std::size_t columns,
                  NumberTable& table) {
  std::vector<Shape> shapes(columns);
  for (std::size_t i = 0; i < words.size(); ++i) shapes[i % columns].add(words[i]);
  // One count of significant digits and of exponent digits for all general columns.
  std::map<int, std::size_t> by_digits;
  std::array<std::size_t, 2> exponents{};
  for (const Shape& shape : shapes) {
    ++by_digits[shape.digits];
    exponents[0] += shape.exponents;
    exponents[1] += shape.long_exponents;
  }
  int digits = 1;
  std::size_t covered = 0;
  for (const auto& [count, number] : by_digits) {
    if (covered * 50 < columns * 49) digits = count;
    covered += number;
  }
  std::vector<Columns> members;
  for (std::size_t c = 0; c < columns; ++c) {
    shapes[c].long_exponents = exponents[1];
    NumberFormat format = format_of(shapes[c], digits);
    if (format.style == NumberStyle::general) {
      format.exponent_digits = exponents[1] * 2 > exponents[0] ? 3 : 2;
    }
    auto found = std::find(table.formats.begin(), table.formats.end(), format);
    if (found == table.formats.end()) {
      if (table.formats.size() == most_formats) {
        found = table.formats.begin();
      } else {
        table.formats.push_back(format);
        members.emplace_back();
        found = table.formats.end() - 1;
      }
    }
    table.columns[c].format = static_cast<std::uint8_t>(found - table.formats.begin());
    members[table.columns[c].format].push_back(c);
  }
  for (std::size_t f = 0; f < table.formats.size(); ++f) {
    table.formats[f] = narrowed(table.formats[f], words, columns, members[f]);
  }
}

void find_twins(NumberTable& table) {
  const std::size_t columns = table.columns.size();
  const std::size_t rows = columns == 0 ? 0 : table.numbers.size() / columns;
  if (rows < 2) return;
  std::map<std::vector<std::int64_t>, std::uint32_t> seen;
  for (std::size_t c = 0; c < columns; ++c) {
    if (table.columns[c].constant) continue;
    std::vector<std::int64_t> key;
    key.reserve(rows + 1);
    key.push_back(table.columns[c].format);
    for (std::size_t r = 0; r < rows; ++r) {
      const CodedNumber& number = table.numbers[r * columns + c];
      key.push_back(number.index * 1000003 ^ static_cast<std::int64_t>(number.fine));
    }
    const auto [place, fresh] = seen.emplace(std::move(key), static_cast<std::uint32_t>(c + 1));
    if (!fresh) table.columns[c].twin = place->second;
  }
}

}  // namespace

NumberTable read_numbers(const std::vector<std::string_view>& words, std::size_t columns) {
  NumberTable table;
  table.columns.resize(columns);
  if (words.empty() || columns == 0) return table;
  find_formats(words, columns, table);
  std::vector<NumberPrinter> printers(table.formats.begin(), table.formats.end());
  table.numbers.resize(words.size());
  table.escaped.resize(words.size());
  for (auto& column : table.columns) column.constant = true;
  for (std::size_t i = 0; i < words.size(); ++i) {
    NumberColumn& column = table.columns[i % columns];
    const auto number = printers[column.format].parse(words[i]);
    if (number) {
      table.numbers[i] = *number;
    } else {
      table.escaped[i] = true;
      column.escapes = true;
      if (i >= columns) table.numbers[i] = table.numbers[i - columns];
    }
    if (table.escaped[i] || table.numbers[i] != table.numbers[i % columns]) column.constant = false;
    if (i < columns) column.first = table.numbers[i];
  }
  find_twins(table);
  const auto references = find_references(table);
  for (std::size_t c = 0; c < columns; ++c) table.columns[c].references = references[c];
  return table;
}

}  // namespace reprise
