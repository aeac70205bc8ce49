// Principal component analysis of markers over many takes.
#pragma once

#include <Eigen/Core>

#include "ingest/virtual_markers.h"

namespace reprise {

/// Sums from which mean and covariance follow. Sums of takes are added in a fixed order, so that
/// the result does not depend on the number of threads.
struct MarkerMoments {
  double count = 0;
  Eigen::VectorXd sum;
  Eigen::MatrixXd products;  ///< sum of x x^T

  void add(const MarkerMatrix& markers);
  void add(const MarkerMoments& other);
  Eigen::VectorXd mean() const;
  /// Second moment about `centre`.
  Eigen::MatrixXd covariance(const Eigen::VectorXd& centre) const;
};

/// The fewest leading axes (dimensions x axes, orthonormal) outside the span of `known` (which may
/// have no columns) that leave at most `residual` of squared distance a frame (mm^2), and of each
/// axis its variance.
struct PrincipalAxes {
  Eigen::MatrixXd axes;
  Eigen::VectorXd variance;
};
PrincipalAxes principal_axes(const Eigen::MatrixXd& covariance, const Eigen::MatrixXd& known,
                             double residual);

}  // namespace reprise
