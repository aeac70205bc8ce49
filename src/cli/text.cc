#include "cli/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace reprise::cli {
namespace {

/// Columns that UTF-8 text takes, one a code point.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::string pad(const std::string& text, std::size_t columns, Table::Align align) {
  const std::string space(columns - std::min(columns, width(text)), ' ');
  return align == Table::Align::left ? text + space : space + text;
}

}  // namespace

std::string format_size(std::uint64_t bytes) {
  constexpr std::array units{"B", "kB", "MB", "GB", "TB", "PB", "EB"};
  if (bytes < 1000) return fmt::format("{} B", bytes);
  double value = static_cast<double>(bytes);
  std::size_t unit = 0;
  // 999.95 would be printed as 1000.0.
  while (value >= 999.95 && unit + 1 < units.size()) {
    value /= 1000;
    ++unit;
  }
  return fmt::format("{:.1f} {}", value, units[unit]);
}

std::string format_ratio(std::uint64_t larger, std::uint64_t smaller) {
  if (larger == 0 || smaller == 0) return "-";
  return fmt::format("{:.1f}:1", static_cast<double>(larger) / static_cast<double>(smaller));
}

std::string format_number(double value, int decimals) {
  return fmt::format("{:.{}f}", value, decimals);
}

std::string format_errors(const PositionErrors& errors) {
  return fmt::format("mean {:.2f} mm, rms {:.2f} mm, p99 {:.2f} mm, max {:.2f} mm", errors.mean,
                     errors.rms, errors.p99, errors.max);
}

std::string format_turns(const RotationErrors& errors) {
  return fmt::format("mean {:.2f} degrees, p99 {:.2f} degrees, max {:.2f} degrees", errors.mean,
                     errors.p99, errors.max);
}

std::string format_clock(double seconds) {
  const auto total = static_cast<std::uint64_t>(std::llround(std::max(0.0, seconds)));
  const auto hours = total / 3600;
  const auto minutes = total / 60 % 60;
  if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, minutes, total % 60);
  return fmt::format("{}:{:02}", minutes, total % 60);
}

std::string format_count(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string printable(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) c = '?';
  }
  return result;
}

void Table::add(std::vector<std::string> cells) {
  assert(cells.size() == columns_.size());
  for (std::string& cell : cells) cell = printable(cell);
  rows_.push_back(std::move(cells));
}

std::string Table::text(bool bold) const {
  std::vector<std::size_t> widths;
  bool headed = false;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    std::size_t widest = width(columns_[i].heading);
    for (const auto& row : rows_) widest = std::max(widest, width(row[i]));
    widths.push_back(widest);
    headed = headed || !columns_[i].heading.empty();
  }
  const auto line_of = [&](const auto& cell_of) {
    std::string line;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (i > 0) line += "  ";
      line += pad(cell_of(i), widths[i], columns_[i].align);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    return line;
  };
  std::string result;
  if (headed) {
    const std::string heading = line_of([&](std::size_t i) { return columns_[i].heading; });
    result += bold ? "\033[1m" + heading + "\033[0m\n" : heading + "\n";
  }
  for (const auto& row : rows_) result += line_of([&](std::size_t i) { return row[i]; }) + "\n";
  return result;
}

}  // namespace reprise::cli
