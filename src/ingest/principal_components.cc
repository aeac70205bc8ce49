#include "ingest/principal_components.h"

#include "model/symmetric_eigen.h"

namespace reprise {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void MarkerMoments::add(const MarkerMatrix& markers) {
  if (count == 0) {
    sum = VectorXd::Zero(markers.cols());
    products = MatrixXd::Zero(markers.cols(), markers.cols());
  }
  count += static_cast<double>(markers.rows());
  sum += markers.colwise().sum().transpose();
  products.noalias() += markers.transpose() * markers;
}

void MarkerMoments::add(const MarkerMoments& other) {
  if (other.count == 0) return;
  if (count == 0) {
    *this = other;
    return;
  }
  count += other.count;
  sum += other.sum;
  products += other.products;
}

VectorXd MarkerMoments::mean() const { return sum / count; }

MatrixXd MarkerMoments::covariance(const VectorXd& centre) const {
  const VectorXd m = mean();
  return products / count - m * centre.transpose() - centre * m.transpose() +
         centre * centre.transpose();
}

PrincipalAxes principal_axes(const MatrixXd& covariance, const MatrixXd& known, double residual) {
  // A skeleton may have nothing that markers could carry.
  if (covariance.rows() == 0) return {MatrixXd(0, 0), VectorXd(0)};
  MatrixXd rest = covariance;
  if (known.cols() > 0) {
    const MatrixXd outside =
        MatrixXd::Identity(covariance.rows(), covariance.cols()) - known * known.transpose();
    rest = outside * covariance * outside;
  }
  const SymmetricEigen solved = symmetric_eigen(rest);
  const Eigen::Index dimensions = rest.rows();
  const Eigen::Index most = dimensions - known.cols();
  double left = rest.trace();
  Eigen::Index count = 0;
  while (count < most && left > residual) {
    left -= solved.values[dimensions - 1 - count];
    ++count;
  }
  PrincipalAxes result{MatrixXd(dimensions, count), VectorXd(count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    result.axes.col(k) = solved.vectors.col(dimensions - 1 - k);
    result.variance[k] = solved.values[dimensions - 1 - k];
    // An eigenvector has no sign; fix it, so that equal input gives equal bytes.
    Eigen::Index largest = 0;
    result.axes.col(k).cwiseAbs().maxCoeff(&largest);
    if (result.axes(largest, k) < 0) result.axes.col(k) *= -1;
  }
  return result;
}

}  // namespace reprise
