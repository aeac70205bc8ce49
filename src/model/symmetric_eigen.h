#pragma once

#include <Eigen/Core>

namespace reprise {

/// What a symmetric matrix does along its own axes.
struct SymmetricEigen {
  Eigen::VectorXd values;   ///< n eigenvalues, ascending.
  Eigen::MatrixXd vectors;  ///< n x n: a unit eigenvector a column, in the order of the values.
};

/// Of an n x n matrix, of which the lower triangle is read. Eigen's solver is compiled in this one
/// place, as it takes longer to compile than the files that need it.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

}  // namespace reprise
