#include "contacts/normal_equations.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace reprise {

NormalEquations::NormalEquations(std::size_t unknowns) : unknowns_(unknowns) {
  assert(unknowns <= most_unknowns);
  for (std::size_t i = 0; i < unknowns_; ++i) {
    std::fill(rows_[i].begin() + static_cast<std::ptrdiff_t>(i), rows_[i].end(), 0.0);
  }
}

void NormalEquations::add(std::size_t unknown, double weight, double value) {
  rows_[unknown][unknown] += weight;
  rows_[unknown][unknowns_] += weight * value;
}

std::array<double, NormalEquations::most_unknowns> NormalEquations::solve() {
  // U with U^T U = A, and U^-T b, row by row; the rows below are updated at once, in loops whose
  // steps do not wait for each other. The diagonal holds reciprocals: dividing is slow.
  for (std::size_t i = 0; i < unknowns_; ++i) {
    auto& row = rows_[i];
    row[i] = 1 / std::sqrt(row[i]);
    for (std::size_t k = i + 1; k <= unknowns_; ++k) row[k] *= row[i];
    for (std::size_t j = i + 1; j < unknowns_; ++j) {
      const double part = row[j];
      for (std::size_t k = j; k <= unknowns_; ++k) rows_[j][k] -= part * row[k];
    }
  }
  std::array<double, most_unknowns> solution{};
  for (std::size_t i = unknowns_; i-- > 0;) {
    solution[i] = rows_[i][unknowns_] * rows_[i][i];
    for (std::size_t j = 0; j < i; ++j) rows_[j][unknowns_] -= rows_[j][i] * solution[i];
  }
  return solution;
}

}  // namespace reprise
