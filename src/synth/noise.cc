#include "synth/noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace reprise::synth {
namespace {

/// Weights of a Gaussian whose output of white noise has the variance 1.
Eigen::VectorXd unit_filter(double sigma_frames) {
  const long reach = std::max(1L, std::lround(3 * sigma_frames));
  Eigen::VectorXd weights(2 * reach + 1);
  for (long k = -reach; k <= reach; ++k) {
    const double u = static_cast<double>(k) / std::max(sigma_frames, 0.3);
    weights[k + reach] = std::exp(-0.5 * u * u);
  }
  return weights / weights.norm();
}

}  // namespace

void add_noise(PoseMatrix& poses, const NoiseOptions& options, Random random) {
  const Eigen::VectorXd filter = unit_filter(options.sigma * options.frame_rate);
  Eigen::VectorXd white(options.count + filter.size() - 1);
  Eigen::VectorXd envelope = Eigen::VectorXd::Ones(options.count);
  for (long i = 0; i < std::min(options.fade, options.count); ++i) {
    const double rise =
        minimum_jerk(static_cast<double>(i + 1) / static_cast<double>(options.fade + 1));
    envelope[i] = std::min(envelope[i], rise);
    envelope[options.count - 1 - i] = std::min(envelope[options.count - 1 - i], rise);
  }
  const auto add = [&](int column, double amplitude) {
    for (double& value : white) value = random.gaussian();
    for (long i = 0; i < options.count; ++i) {
      poses(options.first + i, column) +=
          amplitude * envelope[i] * filter.dot(white.segment(i, filter.size()));
    }
  };
  for (int axis = 0; axis < 3; ++axis) add(root_yaw + axis, options.degrees / std::sqrt(3.0));
  for (int joint = 1; joint < joint_count; ++joint) {
    const auto& free = describe(joint).free;
    const auto axes = options.free_only ? std::count(free.begin(), free.end(), true) : 3;
    for (int axis = 0; axis < 3; ++axis) {
      if (options.free_only && !free[static_cast<std::size_t>(axis)]) continue;
      add(angle_column(joint) + axis, options.degrees / std::sqrt(static_cast<double>(axes)));
    }
  }
}

}  // namespace reprise::synth
