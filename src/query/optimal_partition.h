// Fisher's optimal partition of a sequence.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace reprise {

/// First rows of the `runs` runs of consecutive rows that have the least sum of squared distances
/// to the mean of their run; of partitions that are equally good the one with the earlier borders.
/// At most as many runs as rows. By dynamic programming: rows^2 x (columns + runs) steps.
std::vector<long> optimal_partition(const Eigen::MatrixXd& rows, int runs);

}  // namespace reprise
