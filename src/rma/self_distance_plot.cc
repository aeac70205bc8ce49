#include "rma/self_distance_plot.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace reprise {
namespace {

bool is_least_around(const PostureMatrix& distances, long x, long y) {
  for (long dx = -1; dx <= 1; ++dx) {
    for (long dy = -1; dy <= 1; ++dy) {
      const long i = x + dx, k = y + dy;
      const bool inside = i >= 0 && k >= 0 && i < distances.rows() && k < distances.cols();
      if (inside && distances(i, k) < distances(x, y)) return false;
    }
  }
  return true;
}

}  // namespace

PostureMatrix self_distances(const PostureMatrix& projected) {
  PostureMatrix distances = -2 * projected * projected.transpose();
  distances.colwise() += projected.rowwise().squaredNorm();
  distances.rowwise() += projected.rowwise().squaredNorm().transpose();
  return distances.cwiseMax(0).cwiseSqrt();
}

std::vector<NearPair> plot_minima(const PostureMatrix& distances, std::size_t take,
                                  const RepeatConstants& constants) {
  const long least_lag = std::lround(std::ceil(constants.least_lag_s * constants.rate));
  std::vector<std::tuple<float, long, long>> minima;
  for (long x = 0; x < distances.rows(); ++x) {
    for (long y = x + least_lag; y < distances.cols(); ++y) {
      if (distances(x, y) < constants.similar_mm && is_least_around(distances, x, y)) {
        minima.emplace_back(distances(x, y), x, y);
      }
    }
  }
  std::sort(minima.begin(), minima.end());
  std::vector<NearPair> pairs;
  const auto number = static_cast<std::uint32_t>(take);
  for (const auto& [distance, x, y] : minima) {
    pairs.push_back({number, static_cast<std::int32_t>(x), number, static_cast<std::int32_t>(y)});
  }
  return pairs;
}

}  // namespace reprise
