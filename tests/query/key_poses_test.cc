#include "reprise/query/key_poses.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "query/optimal_partition.h"
#include "reprise/synth/library.h"

namespace reprise {
namespace {

double cost_of(const Eigen::MatrixXd& rows, const std::vector<long>& starts) {
  double cost = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const long end = i + 1 < starts.size() ? starts[i + 1] : rows.rows();
    const auto run = rows.middleRows(starts[i], end - starts[i]);
    cost += (run.rowwise() - run.colwise().mean()).squaredNorm();
  }
  return cost;
}

/// The least cost of all partitions, by trying each.
double least_cost(const Eigen::MatrixXd& rows, int runs) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<long> starts = {0};
  const std::function<void()> go_on = [&] {
    if (static_cast<int>(starts.size()) == runs) {
      least = std::min(least, cost_of(rows, starts));
      return;
    }
    for (long next = starts.back() + 1; next < rows.rows(); ++next) {
      starts.push_back(next);
      go_on();
      starts.pop_back();
    }
  };
  go_on();
  return least;
}

TEST(OptimalPartition, NoPartitionIsBetter) {
  std::mt19937 random(3);
  std::normal_distribution<double> values(0, 10);
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::MatrixXd rows =
        Eigen::MatrixXd::NullaryExpr(12, 3, [&] { return values(random); });
    for (int runs = 1; runs <= 5; ++runs) {
      const auto starts = optimal_partition(rows, runs);
      ASSERT_EQ(starts.size(), static_cast<std::size_t>(runs));
      EXPECT_NEAR(cost_of(rows, starts), least_cost(rows, runs), 1e-9);
    }
  }
}

TEST(OptimalPartition, StepsAreItsBorders) {
  Eigen::MatrixXd rows(30, 2);
  for (long i = 0; i < 30; ++i) rows.row(i).setConstant(i < 7 ? 5.0 : i < 19 ? -2.0 : 40.0);
  EXPECT_EQ(optimal_partition(rows, 3), (std::vector<long>{0, 7, 19}));
}

TEST(OptimalPartition, ThereAreNoMoreRunsThanRows) {
  EXPECT_EQ(optimal_partition(Eigen::MatrixXd::Ones(1, 4), 5), (std::vector<long>{0}));
  EXPECT_EQ(optimal_partition(Eigen::MatrixXd::Random(3, 4), 9), (std::vector<long>{0, 1, 2}));
}

TEST(KeyPoses, FollowEachOtherThroughTheTake) {
  SynthOptions options;
  options.takes = 2;
  options.seconds = 5;
  for (const Take& take : make_synthetic_library(options).takes) {
    const auto poses = key_poses(take);
    ASSERT_EQ(poses.size(), 8u);
    EXPECT_EQ(poses.front().start, 0);
    EXPECT_EQ(poses.back().end, take.seconds());
    for (std::size_t i = 0; i < poses.size(); ++i) {
      EXPECT_LE(poses[i].start, poses[i].time);
      EXPECT_LT(poses[i].time, poses[i].end);
      if (i > 0) EXPECT_EQ(poses[i].start, poses[i - 1].end);
    }
  }
}

}  // namespace
}  // namespace reprise
