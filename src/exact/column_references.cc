#include "exact/column_references.h"

#include <algorithm>
#include <cmath>

namespace reprise {
namespace {

/// How many columns before one are looked at.
constexpr std::size_t farthest = 256;
/// Errors beyond so many times the median say no more than that.
constexpr double clip = 8;
/// Bits that a reference costs: its place, and what is lost until its weight is known.
constexpr double cost = 20;

using Turns = std::vector<double>;

double dot(const Turns& a, const Turns& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// How much a column's changes change, row by row; extremes are cut.
Turns turns_of(const NumberTable& table, std::size_t column) {
  const std::size_t columns = table.columns.size();
  const NumberPrinter printer(table.formats[table.columns[column].format]);
  const std::size_t rows = table.numbers.size() / columns;
  std::vector<std::int64_t> values(rows);
  for (std::size_t r = 0; r < rows; ++r) {
    values[r] = value_of(printer.grid(), table.numbers[r * columns + column].index);
  }
  Turns turns;
  for (std::size_t r = 2; r < rows; ++r) {
    turns.push_back(static_cast<double>(values[r] - 2 * values[r - 1] + values[r - 2]));
  }
  Turns magnitudes(turns.size());
  for (std::size_t i = 0; i < turns.size(); ++i) magnitudes[i] = std::abs(turns[i]);
  const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(turns.size() / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.end());
  const double most = clip * std::max(*middle, 1.0);
  for (double& turn : turns) turn = std::clamp(turn, -most, most);
  return turns;
}

}  // namespace

std::vector<ColumnReferences> find_references(const NumberTable& table) {
  const std::size_t columns = table.columns.size();
  std::vector<ColumnReferences> found(columns);
  if (columns == 0 || table.numbers.size() / columns < 8) return found;
  std::vector<std::size_t> known;  // columns that are coded, in order
  std::vector<Turns> turns;
  std::vector<double> powers;
  for (std::size_t c = 0; c < columns; ++c) {
    if (table.columns[c].constant || table.columns[c].twin != 0) continue;
    Turns rest = turns_of(table, c);
    const Turns own = rest;
    const std::size_t first = known.size() - std::min(known.size(), farthest);
    Turns chosen;
    for (std::uint32_t& reference : found[c]) {
      std::size_t best = known.size();
      double most = 0;
      for (std::size_t k = first; k < known.size(); ++k) {
        if (powers[k] == 0) continue;
        const double along = dot(rest, turns[k]);
        if (along * along / powers[k] > most) most = along * along / powers[k], best = k;
      }
      const double power = dot(rest, rest);
      if (best == known.size() || power == 0) break;
      const double saved =
          -0.5 * std::log2(std::max(1 - most / power, 1e-12)) * static_cast<double>(rest.size());
      if (saved < cost) break;
      reference = static_cast<std::uint32_t>(known[best] + 1);
      // What is left beside all that were chosen, one after the other.
      Turns direction = turns[best];
      if (!chosen.empty()) {
        const double part = dot(direction, chosen) / dot(chosen, chosen);
        for (std::size_t i = 0; i < rest.size(); ++i) direction[i] -= part * chosen[i];
      }
      const double length = dot(direction, direction);
      if (length == 0) break;
      const double along = dot(rest, direction) / length;
      for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= along * direction[i];
      chosen = std::move(direction);
    }
    known.push_back(c);
    powers.push_back(dot(own, own));
    turns.push_back(own);
  }
  return found;
}

}  // namespace reprise
