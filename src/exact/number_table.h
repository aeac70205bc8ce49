// All numbers of a motion text as a table: a row a frame, a column for each number of a frame.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "exact/adaptive_prediction.h"
#include "exact/number_format.h"

namespace reprise {

/// One column of the numbers.
struct NumberColumn {
  std::uint8_t format = 0;  ///< which of the table's
  bool constant = false;    ///< every number is `first`
  bool escapes = false;     ///< some numbers are kept as text, since the format does not give them
  std::uint32_t twin = 0;   ///< 0, or 1 + an earlier column that mostly has the same numbers
  ColumnReferences references{};  ///< of columns that are neither constant nor twins
  std::int64_t start = 0;         ///< what the first value may be like
  CodedNumber first;              ///< of constant columns
};

struct NumberTable {
  std::vector<NumberFormat> formats;
  std::vector<NumberColumn> columns;
  /// Row by row; those that are escaped repeat the number above them.
  std::vector<CodedNumber> numbers;
  std::vector<bool> escaped;
};

constexpr std::size_t most_formats = 32;

/// Finds formats and reads the numbers by them; `words` has `columns` of them a row.
NumberTable read_numbers(const std::vector<std::string_view>& words, std::size_t columns);

}  // namespace reprise
