#include "ingest/principal_components.h"

#include <gtest/gtest.h>

#include <random>

namespace reprise {
namespace {

MarkerMatrix random_markers(Eigen::Index frames, Eigen::Index dimensions, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  MarkerMatrix markers(frames, dimensions);
  for (Eigen::Index f = 0; f < frames; ++f) {
    for (Eigen::Index d = 0; d < dimensions; ++d) {
      markers(f, d) = 100.0 + normal(random) * 50.0 / static_cast<double>(1 + d);
    }
  }
  return markers;
}

TEST(PrincipalComponents, AxesAreOrthonormalAndLeaveWhatWasAllowed) {
  MarkerMoments moments;
  const MarkerMatrix markers = random_markers(500, 12, 1);
  moments.add(markers);
  for (const double allowed : {1e5, 300.0, 50.0, 0.0}) {
    const auto found =
        principal_axes(moments.covariance(moments.mean()), Eigen::MatrixXd(12, 0), allowed);
    const Eigen::MatrixXd unit = found.axes.transpose() * found.axes;
    EXPECT_LT((unit - Eigen::MatrixXd::Identity(unit.rows(), unit.cols())).norm(), 1e-9);
    const MarkerMatrix centred = markers.rowwise() - moments.mean().transpose();
    const double left =
        (centred - centred * found.axes * found.axes.transpose()).squaredNorm() / 500.0;
    EXPECT_LE(left, allowed + 1e-6);
  }
}

TEST(PrincipalComponents, FurtherAxesAreOutsideTheKnownOnes) {
  MarkerMoments moments;
  moments.add(random_markers(300, 9, 2));
  const Eigen::MatrixXd covariance = moments.covariance(moments.mean());
  const Eigen::MatrixXd known = principal_axes(covariance, Eigen::MatrixXd(9, 0), 500.0).axes;
  ASSERT_GT(known.cols(), 0);
  const auto more = principal_axes(covariance, known, 1.0);
  EXPECT_LT((known.transpose() * more.axes).norm(), 1e-6);
}

TEST(PrincipalComponents, SumsOfPartsAreTheSumOfAll) {
  const MarkerMatrix markers = random_markers(100, 5, 3);
  MarkerMoments whole, first, second;
  whole.add(markers);
  first.add(MarkerMatrix(markers.topRows(37)));
  second.add(MarkerMatrix(markers.bottomRows(63)));
  first.add(second);
  EXPECT_LT((whole.mean() - first.mean()).norm(), 1e-9);
  EXPECT_LT((whole.covariance(whole.mean()) - first.covariance(whole.mean())).norm(), 1e-6);
}

}  // namespace
}  // namespace reprise
