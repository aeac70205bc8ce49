// Dynamic time warping over a matrix of costs.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace reprise {

using CostMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Distances between the rows of two matrices with as many columns.
CostMatrix row_distances(const Eigen::Ref<const CostMatrix>& a,
                         const Eigen::Ref<const CostMatrix>& b);

/// The cheapest path from the first to the last corner with steps of one row, one column or both;
/// ties go to both. Its cost a step.
double warped_cost(const CostMatrix& costs);
/// Its places: (row, column).
std::vector<std::pair<long, long>> warping_path(const CostMatrix& costs);

/// Columns, half open.
struct ColumnRange {
  long begin = 0;
  long end = 0;
};
/// Which columns all rows, at least one, fit best, at half to twice their speed: the cheapest path
/// from the first row to the last that begins and ends in any column. Without one (fewer columns
/// than half the rows) all columns.
ColumnRange best_fit(const CostMatrix& costs);

}  // namespace reprise
