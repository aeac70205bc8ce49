#include "refine/refiner.h"

#include <algorithm>
#include <cmath>

#include "refine/contact_fit.h"

namespace reprise {
namespace {

using Eigen::Index;

/// Places that are still off after this many passes take all that has this part in their error
/// along with what has most.
constexpr int stubborn_pass = 10;
constexpr double stubborn_share = 0.2;
constexpr int most_passes = 40;
/// From this pass on, contacts end where they are still off.
constexpr int cutting_pass = 6;
/// Half octaves by which a stretch may be finer than the one that reaches into its misses.
constexpr int most_apart = 3;
/// Seconds between the coarsest knots, of which the better one is taken.
constexpr double spans_s[] = {0.53, 1.06};
/// Steps to start from, in parts of the bound. The best of them differs from take to take.
constexpr double starts[] = {2.4, 3.4};
/// Rounding of what is written as text with six decimals, and of other machines' sines.
constexpr double rounding_mm = 0.001, rounding_part = 0.001;
}  // namespace

Refiner::Refiner(const Take& take, const RefinementOptions& options)
    : take_(take),
      contacts_(options.contacts),
      bound_(options.bound_mm * (1 - rounding_part) - rounding_mm),
      positions_(joint_positions(*take.skeleton, take.channels)),
      quantiser_(take, options.bound_mm) {}

double Refiner::worst_distance(const PositionMatrix& reached) const {
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

template <class Displacement>
bool Refiner::adapt(StepGrid& steps, bool stubborn, const Displacement& displacement) const {
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
        const double squared = displacement(j, f).squaredNorm();
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

Refiner::Candidate Refiner::search(double step_mm, TimeScales scales) {
  Candidate result{CodedChannels(*take_.skeleton, shape(), scales), {}};
  quantiser_.set_steps(step_mm, result.coded.steps);
  const auto displacement = [&](std::size_t j, Index f) { return quantiser_.displacement(j, f); };
  for (int pass = 0; pass < most_passes; ++pass) {
    result.refinement.decoded = quantiser_.quantise(result.coded);
    if (adapt(result.coded.steps, pass >= stubborn_pass, displacement)) continue;
    finish(result);
    break;
  }
  return result;
}

void Refiner::finish(Candidate& candidate) const {
  Refinement& refinement = candidate.refinement;
  refinement.max_mm = worst_distance(joint_positions(*take_.skeleton, refinement.decoded));
  if (!(refinement.max_mm <= bound_)) return;
  refinement.bytes = candidate.coded.encode();
  refinement.contact_bytes = std::min(refinement.bytes.size(), candidate.coded.contact_bytes());
}

Refiner::Candidate Refiner::best_search() {
  const auto better = [](const Candidate& a, const Candidate& b) {
    const auto &own = a.refinement.bytes, &other = b.refinement.bytes;
    return !own.empty() && (other.empty() || own.size() < other.size());
  };
  TimeScales scales = time_scales(shape(), spans_s[0]);
  Candidate best = search(bound_ * starts[0], scales);
  for (const double span : std::span(spans_s).subspan(1)) {
    const TimeScales other = time_scales(shape(), span);
    if (other.levels == scales.levels) continue;
    Candidate found = search(bound_ * starts[0], other);
    if (!better(found, best)) continue;
    best = std::move(found);
    scales = other;
  }
  for (const double part : std::span(starts).subspan(1)) {
    Candidate found = search(bound_ * part, scales);
    if (better(found, best)) best = std::move(found);
  }
  for (double step = bound_; best.refinement.bytes.empty() && step > bound_ / 1e4; step /= 2) {
    best = search(step, scales);
  }
  if (best.refinement.bytes.empty()) {
    best.coded = CodedChannels(*take_.skeleton, shape(), scales);
    std::fill(best.coded.steps.base.begin(), best.coded.steps.base.end(), -1);
    best.refinement.decoded = quantiser_.quantise(best.coded);
    finish(best);
    best.refinement.bytes = best.coded.encode();
  }
  return best;
}

void Refiner::hold_feet(Candidate& best) {
  const ContactFit fit(take_, positions_, bound_, best.coded, best.refinement);
  Candidate held{best.coded, {}};
  CodedChannels& coded = held.coded;
  coded.contacts = fit.choose();
  for (int pass = 0; pass < most_passes && !coded.contacts.intervals.empty(); ++pass) {
    held.refinement.decoded = quantiser_.quantise(coded);
    PositionMatrix reached = quantiser_.positions();
    fit.hold(coded, held.refinement.decoded, reached);
    const auto displacement = [&](std::size_t j, Index f) -> Eigen::Vector3d {
      const auto at = 3 * static_cast<Index>(j);
      return reached.row(f).segment<3>(at) - positions_.row(f).segment<3>(at);
    };
    if (pass >= cutting_pass && fit.cut(reached, bound_, coded.contacts)) continue;
    if (adapt(coded.steps, pass >= stubborn_pass, displacement)) continue;
    finish(held);
    const std::size_t bytes = held.refinement.bytes.size();
    if (bytes > 0 && fit.pays(reached, bytes)) best = std::move(held);
    return;
  }
}

Refinement Refiner::run() {
  Candidate best = best_search();
  if (contacts_) hold_feet(best);
  return std::move(best.refinement);
}

}  // namespace reprise
