#include "query/optimal_partition.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace reprise {
namespace {

/// Squared distances to the mean of the rows [first, last], of all first <= last.
Eigen::MatrixXd run_costs(const Eigen::MatrixXd& rows) {
  const long count = rows.rows();
  // About the mean of all, where little is lost to rounding.
  const Eigen::MatrixXd centred = rows.rowwise() - rows.colwise().mean();
  Eigen::MatrixXd costs = Eigen::MatrixXd::Zero(count, count);
  for (long first = 0; first < count; ++first) {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(rows.cols());
    double squares = 0;
    for (long last = first; last < count; ++last) {
      sum += centred.row(last);
      squares += centred.row(last).squaredNorm();
      costs(first, last) =
          std::max(0.0, squares - sum.squaredNorm() / static_cast<double>(last - first + 1));
    }
  }
  return costs;
}

}  // namespace

std::vector<long> optimal_partition(const Eigen::MatrixXd& rows, int runs) {
  assert(rows.rows() > 0 && runs > 0);
  const long count = rows.rows();
  const long parts = std::min<long>(runs, count);
  const Eigen::MatrixXd costs = run_costs(rows);
  // least(k, last): of the rows up to `last` in k + 1 runs; begin(k, last): where the last run
  // begins.
  Eigen::MatrixXd least =
      Eigen::MatrixXd::Constant(parts, count, std::numeric_limits<double>::max());
  Eigen::Matrix<long, Eigen::Dynamic, Eigen::Dynamic> begin(parts, count);
  least.row(0) = costs.row(0);
  begin.setZero();
  for (long k = 1; k < parts; ++k) {
    for (long last = k; last < count; ++last) {
      for (long first = k; first <= last; ++first) {
        const double cost = least(k - 1, first - 1) + costs(first, last);
        if (cost < least(k, last)) {
          least(k, last) = cost;
          begin(k, last) = first;
        }
      }
    }
  }
  std::vector<long> starts(static_cast<std::size_t>(parts));
  long last = count - 1;
  for (long k = parts - 1; k >= 0; --k) {
    starts[static_cast<std::size_t>(k)] = begin(k, last);
    last = begin(k, last) - 1;
  }
  return starts;
}

}  // namespace reprise
