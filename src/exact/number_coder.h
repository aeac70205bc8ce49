// Codes a table of numbers row by row.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/linear_prediction.h"
#include "exact/number_format.h"
#include "exact/number_table.h"
#include "exact/residual_model.h"

namespace reprise {

/// One row of a table, while it is coded.
struct NumberRow {
  std::span<CodedNumber> numbers;
  std::span<std::uint8_t> escaped;  ///< 1: the number is kept as text
};

/// What both directions know while they go through a table.
class NumberCoder {
 public:
  NumberCoder(const NumberTable& table, const LinearPrediction& prediction);

  /// Writes a row, or reads it into `row`.
  template <class Coding>
  void code_row(Coding& coding, NumberRow row);

  const NumberPrinter& printer(std::size_t column) const {
    return printers_[columns_[column].format];
  }
  const std::vector<NumberColumn>& columns() const { return columns_; }

 private:
  /// Of each column.
  struct History {
    ResidualHistory residuals;
    BitCounter escapes, twins;
    CodedNumber last;
  };

  template <class Coding>
  CodedNumber code_number(Coding& coding, std::size_t column, const CodedNumber& number);
  template <class Coding>
  std::uint64_t code_fine(Coding& coding, const NumberPrinter& printer, std::int64_t magnitude,
                          std::uint64_t fine);

  std::vector<NumberPrinter> printers_;
  std::vector<NumberColumn> columns_;
  std::vector<std::size_t> coded_;  ///< the columns that are not constant
  std::vector<History> histories_;
  PredictionState prediction_;
  ResidualModel residuals_;
  BitCounter zeros_;
  std::array<BitCounter, NumberPrinter::tiny_decades> decades_;
};

inline NumberCoder::NumberCoder(const NumberTable& table, const LinearPrediction& prediction)
    : printers_(table.formats.begin(), table.formats.end()),
      columns_(table.columns),
      histories_(table.columns.size()),
      prediction_(prediction, table.columns.size()),
      residuals_(table.columns.size()) {
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
    if (row.escaped[c] == 0) {
      const CodedNumber* const twin = column.twin == 0 ? nullptr : &row.numbers[column.twin - 1];
      if (twin != nullptr && coding.bit(history.twins, number == *twin)) {
        number = *twin;
      } else {
        number = code_number(coding, c, number);
      }
    }
    history.last = number;
    prediction_.set(c, value_of(printer(c).grid(), number.index));
  }
  prediction_.end_row();
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
  if (printer.format().style == NumberStyle::general) {
    coded.fine = code_fine(coding, printer, value < 0 ? -value : value, number.fine);
  }
  return coded;
}

template <class Coding>
std::uint64_t NumberCoder::code_fine(Coding& coding, const NumberPrinter& printer,
                                     std::int64_t magnitude, std::uint64_t fine) {
  if (magnitude == 0) {
    if (coding.bit(zeros_, fine == 0)) return 0;
    const std::uint64_t size = printer.decade_size(), rest = fine - 1;
    const std::uint64_t decade =
        code_symbol(coding, decades_, 6, static_cast<std::uint32_t>(rest / size));
    return 1 + decade * size + code_uniform(coding, rest % size, size);
  }
  const int digits = printer.fine_digits(magnitude);
  if (digits == 0) return 0;
  std::uint64_t total = 1;
  for (int i = 0; i < digits; ++i) total *= 10;
  return code_uniform(coding, fine, total);
}

}  // namespace reprise
