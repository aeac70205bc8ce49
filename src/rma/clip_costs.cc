#include "rma/clip_costs.h"

#include <cmath>
#include <numeric>
#include <vector>

namespace reprise {
namespace {

double standard_deviation(const std::vector<double>& values) {
  if (values.empty()) return 0;
  const double count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / count);
}

}  // namespace

double primary_cost(const PostureMatrix& take, long begin, long end) {
  const long median = begin + (end - begin) / 2;
  std::vector<double> distances;
  for (long s = begin; s < end; ++s) {
    distances.push_back((take.row(median) - take.row(s)).norm());
  }
  return standard_deviation(distances) * static_cast<double>(end - begin) +
         (take.row(median) - take.row(0)).norm();
}

double repeated_cost(const PostureMatrix& take, long begin, long end, const PostureMatrix& other,
                     std::span<const long> reference) {
  std::vector<double> distances;
  for (long s = begin; s < end; ++s) {
    distances.push_back(
        (other.row(reference[static_cast<std::size_t>(s - begin)]) - take.row(s)).norm());
  }
  return standard_deviation(distances) * static_cast<double>(end - begin);
}

}  // namespace reprise
