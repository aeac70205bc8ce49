#include "rma/behaviour_segments.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "model/symmetric_eigen.h"

namespace reprise {
namespace {

/// Mean and covariance of samples that come in pieces, so that a model may grow at the cost of what
/// it grows by.
class GrowingMoments {
 public:
  /// Of no sample yet. Products are summed about `origin`, near which the samples should be.
  explicit GrowingMoments(const Eigen::RowVectorXd& origin)
      : origin_(origin),
        sum_(Eigen::RowVectorXd::Zero(origin.size())),
        products_(Eigen::MatrixXd::Zero(origin.size(), origin.size())) {}

  void add(const Eigen::Ref<const Eigen::MatrixXd>& samples) {
    const Eigen::MatrixXd about = samples.rowwise() - origin_;
    sum_ += about.colwise().sum();
    products_.noalias() += about.transpose() * about;
    count_ += static_cast<double>(samples.rows());
  }

  Eigen::RowVectorXd mean() const { return origin_ + sum_ / count_; }
  Eigen::MatrixXd covariance() const {
    return products_ / count_ - sum_.transpose() * sum_ / (count_ * count_);
  }

 private:
  Eigen::RowVectorXd origin_, sum_;
  Eigen::MatrixXd products_;
  double count_ = 0;
};

/// A Gaussian whose lesser axes all have the same variance.
class ProbabilisticModel {
 public:
  ProbabilisticModel(const GrowingMoments& moments, double share) : mean_(moments.mean()) {
    const SymmetricEigen solved = symmetric_eigen(moments.covariance());
    axes_ = solved.vectors.rowwise().reverse();
    variance_ = solved.values.reverse().cwiseMax(least_variance);
    const double all = variance_.sum();
    Eigen::Index kept = 0;
    for (double covered = 0; kept < variance_.size() && covered < share * all; ++kept) {
      covered += variance_[kept];
    }
    const Eigen::Index rest = variance_.size() - kept;
    if (rest > 0) variance_.tail(rest).setConstant(variance_.tail(rest).mean());
  }

  double mean_squared_distance(const Eigen::Ref<const Eigen::MatrixXd>& samples) const {
    const Eigen::MatrixXd on_axes = (samples.rowwise() - mean_) * axes_;
    return (on_axes.array().square().rowwise() / variance_.transpose().array()).sum() /
           static_cast<double>(samples.rows());
  }

 private:
  /// mm^2: far below what capture resolves, so that a still model stays a model.
  static constexpr double least_variance = 1e-2;
  Eigen::RowVectorXd mean_;
  Eigen::MatrixXd axes_;
  Eigen::VectorXd variance_;
};

std::vector<long> forward_cuts(const Eigen::MatrixXd& samples, double rate,
                               const SegmentConstants& constants) {
  const auto samples_of = [&](double seconds) { return std::max(1L, std::lround(seconds * rate)); };
  const long initial = samples_of(constants.initial_s), test = samples_of(constants.test_s);
  const long step = samples_of(constants.step_s);
  std::vector<long> cuts;
  long start = 0, size = initial;
  double valley = 0, peak = 0;
  long peak_at = 0;
  bool fresh = true;
  std::optional<GrowingMoments> moments;
  for (long known = 0; start + size + test <= samples.rows(); size += step) {
    if (fresh) {
      moments.emplace(samples.row(start));
      known = 0;
    }
    moments->add(samples.middleRows(start + known, size - known));
    known = size;
    const ProbabilisticModel model(*moments, constants.variance_share);
    const double height = model.mean_squared_distance(samples.middleRows(start + size, test));
    if (fresh || height < valley) {
      valley = peak = height;
      fresh = false;
    } else if (height > peak) {
      peak = height;
      peak_at = start + size;
    } else if (peak - valley > constants.least_rise) {
      cuts.push_back(peak_at);
      start = peak_at;
      size = initial - step;
      fresh = true;
    }
  }
  return cuts;
}

}  // namespace

std::vector<long> behaviour_cuts(const PostureMatrix& projected, double rate,
                                 const SegmentConstants& constants) {
  const Eigen::MatrixXd samples = projected.cast<double>();
  std::vector<long> cuts = forward_cuts(samples, rate, constants);
  const Eigen::MatrixXd reversed = samples.colwise().reverse();
  for (const long cut : forward_cuts(reversed, rate, constants)) {
    cuts.push_back(samples.rows() - cut);
  }
  std::sort(cuts.begin(), cuts.end());
  const long same = std::lround(constants.same_cut_s * rate);
  std::vector<long> united;
  for (const long cut : cuts) {
    if (united.empty() || cut - united.back() >= same) united.push_back(cut);
  }
  return united;
}

}  // namespace reprise
