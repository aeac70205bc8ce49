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
/// Seconds between the coarsest knots, of which the better one is taken.
constexpr double spans_s[] = {0.53, 1.06};
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

double Refiner::worst_distance(const ChannelMatrix& decoded) const {
  const PositionMatrix reached = joint_positions(*take_.skeleton, decoded);
  double worst = 0;
  for (Index f = 0; f < reached.rows(); ++f) {
    for (Index j = 0; j < reached.cols(); j += 3) {
      const double squared =
          (reached.row(f).segment<3>(j) - positions_.row(f).segment<3>(j)).squaredNorm();
      if (!(squared <= worst)) worst = squared;
    }
  }
  return std::sqrt(worst);
}

bool Refiner::adapt(StepGrid& steps, bool stubborn) const {
  const double limit = bound_ * bound_;
  auto finer = steps.offsets;
  finer.setZero();
  bool missed = false;
  for (std::size_t j = 0; j < take_.skeleton->joints.size(); ++j) {
    for (Index f = 0; f < take_.frames();) {
      const Index b = steps.block(f);
      Index worst = f;
      double most_squared = 0;
      for (; f < take_.frames() && steps.block(f) == b; ++f) {
        const double squared = quantiser_.displacement(j, f).squaredNorm();
        if (squared <= most_squared) continue;
        most_squared = squared;
        worst = f;
      }
      if (most_squared <= limit) continue;
      missed = true;
      const std::vector<double> shares = quantiser_.shares(j, worst);
      std::vector<double> groups(static_cast<std::size_t>(steps.offsets.cols()), 0.0);
      for (std::size_t i = 0; i < shares.size(); ++i) {
        if (steps.base[i] >= 0) groups[static_cast<std::size_t>(steps.group(i))] += shares[i];
      }
      const double most = *std::max_element(groups.begin(), groups.end());
      const bool far = most_squared > 2 * limit;
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

Refinement Refiner::search(double step_mm, TimeScales scales) {
  Refinement result;
  CodedChannels coded(*take_.skeleton, shape(), scales);
  quantiser_.set_steps(step_mm, coded.steps);
  for (int pass = 0; pass < most_passes; ++pass) {
    result.decoded = quantiser_.quantise(coded);
    if (adapt(coded.steps, pass >= stubborn_pass)) continue;
    result.max_mm = worst_distance(result.decoded);
    if (result.max_mm <= bound_) result.bytes = coded.encode();
    break;
  }
  return result;
}

Refinement Refiner::run() {
  const auto better = [](const Refinement& a, const Refinement& b) {
    return !a.bytes.empty() && (b.bytes.empty() || a.bytes.size() < b.bytes.size());
  };
  Refinement best;
  TimeScales best_scales = time_scales(shape(), spans_s[0]);
  for (const double span : spans_s) {
    const TimeScales scales = time_scales(shape(), span);
    if (span != spans_s[0] && scales.levels == best_scales.levels) continue;
    Refinement found = search(bound_ * starts[0], scales);
    if (!better(found, best)) continue;
    best = std::move(found);
    best_scales = scales;
  }
  for (const double part : std::span(starts).subspan(1)) {
    Refinement found = search(bound_ * part, best_scales);
    if (better(found, best)) best = std::move(found);
  }
  for (double step = bound_; best.bytes.empty() && step > bound_ / 1e4; step /= 2) {
    best = search(step, best_scales);
  }
  if (best.bytes.empty()) {
    CodedChannels coded(*take_.skeleton, shape(), best_scales);
    std::fill(coded.steps.base.begin(), coded.steps.base.end(), -1);
    best.decoded = quantiser_.quantise(coded);
    best.bytes = coded.encode();
    best.max_mm = worst_distance(best.decoded);
  }
  return best;
}

}  // namespace reprise
