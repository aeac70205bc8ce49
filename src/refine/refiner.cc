#include "refine/refiner.h"

#include <algorithm>
#include <cmath>

namespace reprise {
namespace {

using Eigen::Index;

/// Places that are still off after this many passes take all that has this part in their error
/// along with what has most.
constexpr int stubborn_pass = 10;
constexpr double stubborn_share = 0.2;
constexpr int most_passes = 40;
/// Half octaves by which a stretch may be finer than the one that reaches into its misses.
constexpr int most_apart = 3;
/// Steps to start from, in parts of the bound. The best of them differs from take to take.
constexpr double starts[] = {2.4, 3.4};
/// Rounding of what is written as text with six decimals, and of other machines' sines.
constexpr double rounding_mm = 0.001, rounding_part = 0.001;
}  // namespace

Refiner::Refiner(const Take& take, double bound_mm)
    : take_(take),
      bound_(bound_mm * (1 - rounding_part) - rounding_mm),
      positions_(joint_positions(*take.skeleton, take.channels)),
      quantiser_(take, bound_mm) {}

Refiner::Distances Refiner::distances(const ChannelMatrix& decoded) const {
  const PositionMatrix reached = joint_positions(*take_.skeleton, decoded);
  const Index joints = reached.cols() / 3;
  Distances result;
  result.squared.resize(reached.rows(), joints);
  double worst = 0;
  for (Index f = 0; f < reached.rows(); ++f) {
    for (Index j = 0; j < joints; ++j) {
      const double squared =
          (reached.row(f).segment<3>(3 * j) - positions_.row(f).segment<3>(3 * j)).squaredNorm();
      result.squared(f, j) = static_cast<float>(squared);
      if (!(squared <= worst)) worst = squared;
    }
  }
  result.worst = std::sqrt(worst);
  return result;
}

bool Refiner::adapt(const Distances& distances, const ChannelMatrix& decoded, StepGrid& steps,
                    bool stubborn) const {
  const auto limit = static_cast<float>(bound_ * bound_);
  const Index frames = take_.frames(), joints = distances.squared.cols();
  auto finer = steps.offsets;
  finer.setZero();
  bool missed = false;
  std::vector<JointFrame> reached(static_cast<std::size_t>(joints));
  for (Index j = 0; j < joints; ++j) {
    for (Index f = 0; f < frames;) {
      const Index b = steps.block(f);
      Index worst = f;
      for (; f < frames && steps.block(f) == b; ++f) {
        if (distances.squared(f, j) > distances.squared(worst, j)) worst = f;
      }
      if (distances.squared(worst, j) <= limit) continue;
      missed = true;
      forward_kinematics(*take_.skeleton,
                         {decoded.row(worst).data(), static_cast<std::size_t>(decoded.cols())},
                         reached);
      const Eigen::Vector3d source = positions_.row(worst).segment<3>(3 * j).transpose();
      const Eigen::Vector3d error = reached[static_cast<std::size_t>(j)].position - source;
      const Eigen::Vector3d origin = positions_.row(worst).head<3>().transpose();
      const std::vector<double> shares = quantiser_.shares(static_cast<std::size_t>(j), worst,
                                                           error.normalized(), source - origin);
      std::vector<double> groups(static_cast<std::size_t>(steps.offsets.cols()), 0.0);
      for (std::size_t i = 0; i < shares.size(); ++i) {
        if (steps.base[i] >= 0) groups[static_cast<std::size_t>(steps.group(i))] += shares[i];
      }
      const double most = *std::max_element(groups.begin(), groups.end());
      const bool far = distances.squared(worst, j) > 2 * limit;
      // Coarse knots of the block beside this one reach into it.
      const bool early = 2 * worst < steps.first_frame(b) + steps.first_frame(b + 1);
      const Index beside = std::clamp<Index>(early ? b - 1 : b + 1, 0, steps.offsets.rows() - 1);
      for (Index g = 0; g < steps.offsets.cols(); ++g) {
        if (groups[static_cast<std::size_t>(g)] < (stubborn ? stubborn_share : 1.0) * most)
          continue;
        finer(b, g) = std::max<std::int8_t>(finer(b, g), far ? 2 : 1);
        if (stubborn || steps.offsets(b, g) - steps.offsets(beside, g) >= most_apart) {
          finer(beside, g) = std::max<std::int8_t>(finer(beside, g), 1);
        }
      }
    }
  }
  for (Index i = 0; i < finer.size(); ++i) {
    steps.offsets(i) = static_cast<std::int8_t>(
        std::min<int>(steps.offsets(i) + finer(i), StepConstants::most_offset));
  }
  return missed;
}

bool Refiner::search(double step_mm, Refinement& best) {
  CodedChannels coded(*take_.skeleton, {take_.frames(), take_.frame_rate});
  quantiser_.set_steps(step_mm, coded.steps);
  for (int pass = 0; pass < most_passes; ++pass) {
    const ChannelMatrix decoded = quantiser_.quantise(coded);
    const Distances reached = distances(decoded);
    if (reached.worst <= bound_) {
      std::vector<std::uint8_t> bytes = coded.encode();
      if (best.bytes.empty() || bytes.size() < best.bytes.size()) {
        best.bytes = std::move(bytes);
        best.decoded = decoded;
        best.max_mm = reached.worst;
      }
      return true;
    }
    adapt(reached, decoded, coded.steps, pass >= stubborn_pass);
  }
  return false;
}

Refinement Refiner::run() {
  Refinement best;
  for (const double part : starts) search(bound_ * part, best);
  for (double step = bound_; best.bytes.empty() && step > bound_ / 1e4; step /= 2) {
    search(step, best);
  }
  if (best.bytes.empty()) {
    CodedChannels coded(*take_.skeleton, {take_.frames(), take_.frame_rate});
    std::fill(coded.steps.base.begin(), coded.steps.base.end(), -1);
    best.decoded = quantiser_.quantise(coded);
    best.bytes = coded.encode();
    best.max_mm = distances(best.decoded).worst;
  }
  return best;
}

}  // namespace reprise
