#include "rma/posture_reach.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "rma/parallel_for.h"

namespace reprise {
namespace {

/// Every so many-th posture of all takes, so that there are at least this many, or all.
PostureMatrix spread_sample(std::span<const PostureMatrix> takes) {
  constexpr long least = 1000;
  long total = 0;
  for (const PostureMatrix& take : takes) total += take.rows();
  const long stride = std::max(1L, total / least);
  PostureMatrix sample((total + stride - 1) / stride, takes.empty() ? 0 : takes[0].cols());
  long next = 0, before = 0;  // counted over all takes
  for (const PostureMatrix& take : takes) {
    for (; next < before + take.rows(); next += stride) {
      sample.row(next / stride) = take.row(next - before);
    }
    before += take.rows();
  }
  return sample;
}

}  // namespace

std::vector<std::vector<float>> posture_reaches(std::span<const PostureMatrix> projected,
                                                double part, unsigned jobs) {
  constexpr long block = 256;  // postures at a time: a long take needs no more memory
  assert(part >= 0 && part <= 1);
  const PostureMatrix sample = spread_sample(projected);
  const Eigen::RowVectorXf squares = sample.rowwise().squaredNorm().transpose();
  const auto rank = static_cast<long>(part * static_cast<double>(sample.rows() - 1));
  std::vector<std::vector<float>> reaches(projected.size());
  parallel_for(projected.size(), jobs, [&](std::size_t t) {
    const PostureMatrix& take = projected[t];
    for (long begin = 0; begin < take.rows(); begin += block) {
      const auto postures = take.middleRows(begin, std::min(block, take.rows() - begin));
      PostureMatrix squared = -2 * postures * sample.transpose();
      squared.rowwise() += squares;
      squared.colwise() += postures.rowwise().squaredNorm();
      for (long s = 0; s < squared.rows(); ++s) {
        float* const distances = squared.row(s).data();
        std::nth_element(distances, distances + rank, distances + squared.cols());
        reaches[t].push_back(std::sqrt(std::max(0.0F, distances[rank])));
      }
    }
  });
  return reaches;
}

float similar_at_reach(float reach, const RepeatConstants& constants, float times) {
  constexpr float least_mm = 1;  // distances are divided by it
  const float part = reach / constants.reach_mm;
  const float far = times * std::pow(part, constants.far_reach_power);
  return std::max(least_mm, constants.similar_mm * std::min(part, far));
}

}  // namespace reprise
