// Least squares of a few unknowns.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace reprise {

/// A x = b with A symmetric and positive definite, of at most `most_unknowns` rows. Plain loops:
/// routines made for matrices of any size spend longer on getting ready for one of six rows than on
/// solving it.
class NormalEquations {
 public:
  static constexpr std::size_t most_unknowns = 16;

  /// Without equations: A and b are 0.
  explicit NormalEquations(std::size_t unknowns);

  /// Adds x[unknown] = value, so heavily weighted.
  void add(std::size_t unknown, double weight, double value);
  /// Adds sum of columns[i] x[unknowns[i]] = value, a vector equation, so heavily weighted;
  /// `unknowns` ascend.
  template <class Vector>
  void add(std::span<const std::size_t> unknowns, std::span<const Vector> columns, double weight,
           const Vector& value) {
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      double* row = rows_[unknowns[i]].data();
      for (std::size_t j = i; j < unknowns.size(); ++j)
        row[unknowns[j]] += weight * columns[i].dot(columns[j]);
      row[unknowns_] += weight * columns[i].dot(value);
    }
  }

  /// By Cholesky's decomposition, in place: what was added is lost.
  std::array<double, most_unknowns> solve();

 private:
  std::size_t unknowns_;
  /// The upper triangle of A, and b behind it.
  std::array<std::array<double, most_unknowns + 1>, most_unknowns> rows_;
};

}  // namespace reprise
