#include "rma/behaviour_groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "model/symmetric_eigen.h"

namespace reprise {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Similarities of segments: Gaussian in their distance, as wide as the median distance of each to
/// its nearest quarter. Where most of them have a twin that is 0, but for rounding.
MatrixXd similarities(const MatrixXd& distances) {
  constexpr double least_width = 1e-6;
  std::vector<double> near;
  for (Eigen::Index i = 0; i < distances.rows(); ++i) {
    std::vector<double> row(static_cast<std::size_t>(distances.cols()));
    VectorXd::Map(row.data(), distances.cols()) = distances.row(i).transpose();
    const auto quarter = row.begin() + static_cast<std::ptrdiff_t>(row.size() / 4);
    std::nth_element(row.begin(), quarter, row.end());
    near.push_back(*quarter);
  }
  std::nth_element(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2),
                   near.end());
  const double width = std::max(near[near.size() / 2], least_width);
  return (-(distances / width).array().square()).exp();
}

/// Parts a set of segments in two again and again, until what is together is near enough.
class NormalisedCut {
 public:
  NormalisedCut(const MatrixXd& distances, const GroupConstants& constants)
      : distances_(distances), weights_(similarities(distances)), constants_(constants) {}

  std::vector<std::vector<Eigen::Index>> run() {
    std::vector<Eigen::Index> all(static_cast<std::size_t>(weights_.rows()));
    std::iota(all.begin(), all.end(), Eigen::Index{0});
    part(all);
    return std::move(parts_);
  }

 private:
  void part(const std::vector<Eigen::Index>& set) {
    std::vector<Eigen::Index> left, right;
    const double apart = mean_distance(set);
    const bool together =
        apart <= constants_.least_distance ||
        (best_cut(set, left, right) > constants_.most_cut && apart <= constants_.most_distance);
    if (together) {
      parts_.push_back(set);
      return;
    }
    part(left);
    part(right);
  }

  double mean_distance(const std::vector<Eigen::Index>& set) const {
    if (set.size() < 2) return 0;
    const auto count = static_cast<double>(set.size());
    return distances_(set, set).sum() / (count * (count - 1));
  }

  /// The cheapest cut along the second eigenvector of the normalised Laplacian.
  double best_cut(const std::vector<Eigen::Index>& set, std::vector<Eigen::Index>& left,
                  std::vector<Eigen::Index>& right) const {
    const MatrixXd w = weights_(set, set);
    const VectorXd degree = w.rowwise().sum();
    const VectorXd scale = degree.cwiseSqrt().cwiseInverse();
    const SymmetricEigen solved = symmetric_eigen(scale.asDiagonal() * w * scale.asDiagonal());
    const VectorXd vector =
        scale.cwiseProduct(solved.vectors.col(static_cast<Eigen::Index>(set.size()) - 2));
    std::vector<std::size_t> order(set.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {},
                             [&](std::size_t i) { return vector[static_cast<Eigen::Index>(i)]; });
    double best = std::numeric_limits<double>::infinity(), cut = 0, left_degree = 0;
    std::size_t best_count = 0;
    const double all_degree = degree.sum();
    std::vector<bool> inside(set.size(), false);
    for (std::size_t count = 1; count < set.size(); ++count) {
      const auto moved = static_cast<Eigen::Index>(order[count - 1]);
      for (std::size_t k = 0; k < set.size(); ++k) {
        if (static_cast<Eigen::Index>(k) == moved) continue;
        const double weight = w(moved, static_cast<Eigen::Index>(k));
        cut += inside[k] ? -weight : weight;
      }
      inside[static_cast<std::size_t>(moved)] = true;
      left_degree += degree[moved];
      const double cost = cut / left_degree + cut / (all_degree - left_degree);
      if (cost < best) {
        best = cost;
        best_count = count;
      }
    }
    for (std::size_t k = 0; k < order.size(); ++k) {
      (k < best_count ? left : right).push_back(set[order[k]]);
    }
    return best;
  }

  const MatrixXd& distances_;
  MatrixXd weights_;
  const GroupConstants& constants_;
  std::vector<std::vector<Eigen::Index>> parts_;
};

std::vector<int> renumbered(const std::vector<int>& groups) {
  std::map<int, int> numbers;
  std::vector<int> result;
  for (const int group : groups) {
    result.push_back(numbers.emplace(group, static_cast<int>(numbers.size())).first->second);
  }
  return result;
}

}  // namespace

SegmentShape segment_shape(const Eigen::Ref<const PostureMatrix>& postures,
                           const GroupConstants& constants) {
  SegmentShape shape;
  const MatrixXd samples = postures.cast<double>();
  const Eigen::RowVectorXd mean = samples.colwise().mean();
  shape.mean_posture = mean.transpose().normalized();
  const MatrixXd centred = samples.rowwise() - mean;
  const SymmetricEigen solved = symmetric_eigen(centred.transpose() * centred);
  const Eigen::Index count = std::min<Eigen::Index>(constants.axes, samples.cols());
  shape.axes = solved.vectors.rightCols(count).rowwise().reverse();
  return shape;
}

double segment_distance(const SegmentShape& a, const SegmentShape& b,
                        const GroupConstants& constants) {
  double weight = 1, weights = 0, axes = 0;
  for (Eigen::Index p = 0; p < std::min(a.axes.cols(), b.axes.cols()); ++p) {
    const double along = std::min(1.0, std::abs(a.axes.col(p).dot(b.axes.col(p))));
    axes += weight * std::sqrt(2 - 2 * along);
    weights += weight;
    weight *= constants.axis_weight;
  }
  if (weights > 0) axes /= weights;
  return constants.axes_share * axes +
         (1 - constants.axes_share) * (a.mean_posture - b.mean_posture).norm();
}

std::vector<int> group_segments(std::span<const SegmentShape> segments,
                                const GroupConstants& constants) {
  if (segments.empty()) return {};
  const std::size_t sampled = std::min(segments.size(), constants.most_sampled);
  std::vector<std::size_t> sample(sampled);
  for (std::size_t i = 0; i < sampled; ++i) sample[i] = i * segments.size() / sampled;
  // Of a segment from itself exactly 0, which rounding would not give.
  MatrixXd distances = MatrixXd::Zero(sampled, sampled);
  for (std::size_t i = 0; i < sampled; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(k);
      distances(a, b) = distances(b, a) =
          segment_distance(segments[sample[i]], segments[sample[k]], constants);
    }
  }
  const auto parts = NormalisedCut(distances, constants).run();
  std::vector<int> groups(segments.size(), -1);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (const Eigen::Index i : parts[p]) {
      groups[sample[static_cast<std::size_t>(i)]] = static_cast<int>(p);
    }
  }
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (groups[s] >= 0) continue;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < parts.size(); ++p) {
      double sum = 0;
      for (const Eigen::Index i : parts[p]) {
        sum +=
            segment_distance(segments[s], segments[sample[static_cast<std::size_t>(i)]], constants);
      }
      if (sum / static_cast<double>(parts[p].size()) < best) {
        best = sum / static_cast<double>(parts[p].size());
        groups[s] = static_cast<int>(p);
      }
    }
  }
  return renumbered(groups);
}

std::vector<std::int64_t> join_groups(std::span<const SegmentShape> segments,
                                      std::span<const KnownSegment> known, std::int64_t next_group,
                                      const GroupConstants& constants) {
  std::vector<std::int64_t> groups(segments.size(), 0);
  std::vector<SegmentShape> others;
  std::vector<std::size_t> place;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    std::map<std::int64_t, std::pair<double, double>> sums;  // of a group: distances, segments
    for (const KnownSegment& segment : known) {
      auto& [sum, count] = sums[segment.group];
      sum += segment_distance(segments[s], segment.shape, constants);
      count += 1;
    }
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [group, sum] : sums) {
      if (sum.first / sum.second >= best) continue;
      best = sum.first / sum.second;
      groups[s] = group;
    }
    if (best <= constants.most_distance) continue;
    others.push_back(segments[s]);
    place.push_back(s);
  }
  const std::vector<int> found = group_segments(others, constants);
  for (std::size_t i = 0; i < place.size(); ++i) groups[place[i]] = next_group + found[i];
  return groups;
}

}  // namespace reprise
