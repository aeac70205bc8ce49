// Numbers and tables for people to read. Nothing here depends on the locale.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "reprise/model/measure.h"

namespace reprise::cli {

/// "999 B", "13.6 MB": decimal units, as file managers have them.
std::string format_size(std::uint64_t bytes);
/// "123.4:1"; "-" where one of them is 0.
std::string format_ratio(std::uint64_t larger, std::uint64_t smaller);
/// `value` with `decimals` digits after the point.
std::string format_number(double value, int decimals);
/// "mean 8.1 mm, rms 9.9 mm, p99 25.0 mm, max 61.2 mm".
std::string format_errors(const PositionErrors& errors);
/// "mean 0.41 degrees, p99 1.90 degrees, max 8.84 degrees".
std::string format_turns(const RotationErrors& errors);
/// "0:07", "12:30", "1:02:03"; whole seconds.
std::string format_clock(double seconds);
/// "1 take", "2 takes".
std::string format_count(std::uint64_t count, std::string_view noun);

/// The text with control characters replaced by '?', so that a name from a file cannot steer a
/// terminal.
std::string printable(std::string_view text);

/// Rows under headings, columns as wide as their widest cell.
class Table {
 public:
  enum class Align { left, right };
  struct Column {
    std::string heading;
    Align align = Align::left;
  };

  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// As many cells as columns. Cells are made printable.
  void add(std::vector<std::string> cells);
  /// The table, each line ended; headings in bold with `bold`. Columns with empty headings only: no
  /// line of headings.
  std::string text(bool bold = false) const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace reprise::cli
