// Codes a table of numbers row by row.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/adaptive_prediction.h"
#include "exact/number_format.h"
#include "exact/number_table.h"
#include "exact/residual_model.h"
#include "exact/rounding_noise.h"

namespace reprise {

/// One row of a table, while it is coded.
struct NumberRow {
  std::span<CodedNumber> numbers;
  std::span<std::uint8_t> escaped;  ///< 1: the number is kept as text
};

/// What both directions know while they go through a table.
class NumberCoder {
 public:
  explicit NumberCoder(const NumberTable& table);

  /// Writes a row, or reads it into `row`.
  template <class Coding>
  void code_row(Coding& coding, NumberRow row);

  const NumberPrinter& printer(std::size_t column) const {
    return printers_[columns_[column].format];
  }
  const std::vector<NumberColumn>& columns() const { return columns_; }

 private:
  static std::vector<ColumnReferences> references_of(const NumberTable& table) {
    std::vector<ColumnReferences> references;
    for (const NumberColumn& column : table.columns) references.push_back(column.references);
    return references;
  }
  static std::vector<std::int64_t> starts_of(const NumberTable& table) {
    std::vector<std::int64_t> starts;
    for (const NumberColumn& column : table.columns) starts.push_back(column.start);
    return starts;
  }
  /// Of each column.
  struct History {
    ResidualHistory residuals;
    BitCounter escapes, twins;
    CodedNumber last;
  };

  template <class Coding>
  CodedNumber code_number(Coding& coding, std::size_t column, const CodedNumber& number);
  /// Of each column that has numbers next to zero.
  struct TinyNumbers {
    std::array<BitCounter, 2> kinds;
    std::array<BitCounter, 32> widths, zeros;
    std::array<BitCounter, NumberPrinter::tiny_decades> decades;
  };

  template <class Coding>
  std::uint64_t code_fine(Coding& coding, std::size_t column, std::int64_t magnitude,
                          std::uint64_t fine);
  template <class Coding>
  std::uint64_t code_tiny(Coding& coding, std::size_t column, std::uint64_t fine);

  std::vector<NumberPrinter> printers_;
  std::vector<NumberColumn> columns_;
  std::vector<std::size_t> coded_;  ///< the columns that are not constant
  std::vector<History> histories_;
  AdaptivePrediction prediction_;
  ResidualModel residuals_;
  std::vector<TinyNumbers> tiny_;
};

inline NumberCoder::NumberCoder(const NumberTable& table)
    : printers_(table.formats.begin(), table.formats.end()),
      columns_(table.columns),
      histories_(table.columns.size()),
      prediction_(references_of(table), starts_of(table)),
      residuals_(table.columns.size()) {
  const bool general = std::any_of(printers_.begin(), printers_.end(), [](const auto& printer) {
    return printer.format().style == NumberStyle::general;
  });
  if (general) tiny_.resize(columns_.size());
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (!columns_[c].constant) coded_.push_back(c);
  }
}

template <class Coding>
void NumberCoder::code_row(Coding& coding, NumberRow row) {
  residuals_.begin_frame();
  for (const std::size_t c : coded_) {
    History& history = histories_[c];
    const NumberColumn& column = columns_[c];
    CodedNumber& number = row.numbers[c];
    if (column.escapes) {
      row.escaped[c] = coding.bit(history.escapes, row.escaped[c] != 0);
      if (row.escaped[c] != 0) number = history.last;
    }
    const CodedNumber* const twin = column.twin == 0 ? nullptr : &row.numbers[column.twin - 1];
    if (row.escaped[c] != 0) {
      prediction_.skip(c, value_of(printer(c).grid(), number.index));
    } else if (twin != nullptr && coding.bit(history.twins, number == *twin)) {
      number = *twin;
      prediction_.skip(c, value_of(printer(c).grid(), number.index));
    } else {
      number = code_number(coding, c, number);
    }
    history.last = number;
  }
}

template <class Coding>
CodedNumber NumberCoder::code_number(Coding& coding, std::size_t column,
                                     const CodedNumber& number) {
  const NumberPrinter& printer = this->printer(column);
  const NumberGrid& grid = printer.grid();
  ResidualHistory& history = histories_[column].residuals;
  const std::int64_t expected = prediction_.predict(column);
  const std::int64_t expected_index = index_of(grid, expected);
  const int log_step = grid.log_step(expected < 0 ? -expected : expected);
  CodedNumber coded;
  coded.index = expected_index +
                residuals_.code(coding, column, history, log_step, number.index - expected_index);
  const std::int64_t value = value_of(grid, coded.index);
  history.update(value < expected ? expected - value : value - expected);
  prediction_.learn(column, value);
  if (printer.format().style == NumberStyle::general) {
    coded.fine = code_fine(coding, column, value < 0 ? -value : value, number.fine);
  }
  return coded;
}

template <class Coding>
std::uint64_t NumberCoder::code_fine(Coding& coding, std::size_t column, std::int64_t magnitude,
                                     std::uint64_t fine) {
  if (magnitude == 0) return code_tiny(coding, column, fine);
  const int digits = printer(column).fine_digits(magnitude);
  if (digits == 0) return 0;
  std::uint64_t total = 1;
  for (int i = 0; i < digits; ++i) total *= 10;
  return code_uniform(coding, fine, total);
}

template <class Coding>
std::uint64_t NumberCoder::code_tiny(Coding& coding, std::size_t column, std::uint64_t fine) {
  const NumberPrinter& printer = this->printer(column);
  TinyNumbers& tiny = tiny_[column];
  if (coding.bit(tiny.kinds[0], fine == 0)) return 0;
  const std::uint32_t noise = Coding::reads ? 0 : noise_of_fine(printer, fine);
  if (coding.bit(tiny.kinds[1], noise != 0)) {
    const auto width = static_cast<int>(
        code_symbol(coding, tiny.widths, 5, static_cast<std::uint32_t>(std::bit_width(noise))));
    const auto zeros = static_cast<int>(code_symbol(
        coding, tiny.zeros, 5, static_cast<std::uint32_t>(std::countr_zero(noise | 1u << 31))));
    // The leading one and the last one are known.
    std::uint32_t multiple = 1;
    for (int rest = width - 2; rest >= 0; --rest) {
      const bool known = rest <= zeros;
      const bool bit = known ? rest == zeros : coding.bits(noise >> rest & 1, 1) != 0;
      multiple = multiple << 1 | static_cast<std::uint32_t>(bit);
    }
    return fine_of_noise(printer, multiple);
  }
  const std::uint64_t size = printer.decade_size(), rest = fine - 1;
  const std::uint64_t decade =
      code_symbol(coding, tiny.decades, 6, static_cast<std::uint32_t>(rest / size));
  return 1 + decade * size + code_uniform(coding, rest % size, size);
}

}  // namespace reprise
