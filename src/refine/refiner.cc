#include "refine/refiner.h"

#include <algorithm>
#include <cmath>

#include "model/angle_units.h"
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
constexpr double rounding_mm = 0.001, rounding_part = 0.001, rounding_degrees = 0.0001;
/// Turns about a straight limb move nothing, up to some angle: beyond it compensation, which is
/// linear, goes wrong. An arm of so many mm, times the root of the bound (mm), holds them
/// (docs/findings/2026-11-25-bounded-coder.md).
constexpr double least_arm_at_one_mm = 20;

double allowed_degrees(const RefinementOptions& options) {
  return options.bound_deg * (1 - rounding_part) - rounding_degrees;
}

/// The distance (mm) at which a point shows a turn of the bound in degrees as the bound in mm.
double arm_mm(const RefinementOptions& options) {
  return std::max(options.bound_mm / (options.bound_deg * radians_per_degree),
                  least_arm_at_one_mm * std::sqrt(options.bound_mm));
}

}  // namespace

Refiner::Refiner(const PreparedTake& prepared, const RefinementOptions& options)
    : prepared_(prepared),
      take_(prepared.take),
      contacts_(options.contacts),
      bounds_(options.bound_mm * (1 - rounding_part) - rounding_mm, allowed_degrees(options)),
      quantiser_(prepared, arm_mm(options)) {}

CodedChannels Refiner::empty_channels(TimeScales scales) const {
  return {*take_.skeleton, prepared_.header.constants, shape(), scales};
}

class Refiner::FinerSteps {
 public:
  FinerSteps(StepGrid& steps, bool stubborn)
      : steps_(steps), stubborn_(stubborn), finer_(steps.offsets) {
    finer_.setZero();
  }

  Index block(Index f) const { return steps_.block(f); }

  /// What has most share in a miss becomes finer in its stretch of time; `ratio`: squared error
  /// over squared limit.
  void add_miss(Index frame, double ratio, const std::vector<double>& shares) {
    missed_ = true;
    const Index b = steps_.block(frame);
    std::vector<double> groups(static_cast<std::size_t>(steps_.offsets.cols()), 0.0);
    for (std::size_t i = 0; i < shares.size(); ++i) {
      if (steps_.base[i] >= 0) groups[static_cast<std::size_t>(steps_.group(i))] += shares[i];
    }
    if (groups.empty()) return;
    const double most = *std::max_element(groups.begin(), groups.end());
    // What is still off after many passes goes back and forth between its causes.
    const bool far = stubborn_ || ratio > 2;
    // Coarse knots of the block beside this one reach into it.
    const bool early = 2 * frame < steps_.first_frame(b) + steps_.first_frame(b + 1);
    const Index beside = std::clamp<Index>(early ? b - 1 : b + 1, 0, steps_.offsets.rows() - 1);
    for (Index g = 0; g < steps_.offsets.cols(); ++g) {
      if (groups[static_cast<std::size_t>(g)] < (stubborn_ ? stubborn_share : 1.0) * most) continue;
      make_finer(b, g, far ? 2 : 1);
      if (stubborn_ || steps_.offsets(b, g) - steps_.offsets(beside, g) >= most_apart) {
        make_finer(beside, g, 1);
      }
    }
  }

  /// A joint that turns too much from the frame before. It does so by its own rounding, or to make
  /// up for that of the joint above, or, where it is stubborn, of any above it.
  void add_pop(std::size_t joint, Index frame) {
    missed_ = true;
    int group = steps_.group_of_joint(joint);
    for (int above = 0; group >= 0 && (stubborn_ || above < 2); ++above) {
      make_finer(steps_.block(frame - 1), group, stubborn_ ? 2 : 1);
      make_finer(steps_.block(frame), group, stubborn_ ? 2 : 1);
      group = steps_.parent_of_group(group);
    }
  }

  /// True if there was something to add.
  bool apply() {
    for (Index i = 0; i < finer_.size(); ++i) {
      steps_.offsets(i) = static_cast<std::int8_t>(
          std::min<int>(steps_.offsets(i) + finer_(i), StepConstants::most_offset));
    }
    return missed_;
  }

 private:
  void make_finer(Index b, Index g, int by) {
    finer_(b, g) = std::max(finer_(b, g), static_cast<std::int8_t>(by));
  }

  StepGrid& steps_;
  bool stubborn_;
  Eigen::Matrix<std::int8_t, Eigen::Dynamic, Eigen::Dynamic> finer_;
  bool missed_ = false;
};

void Refiner::find_misses(std::size_t joint, const PoseTrack& reached, FinerSteps& finer) const {
  const std::vector<JointFrame>&source = quantiser_.source()[joint], &decoded = reached[joint];
  for (Index f = 0; f < take_.frames();) {
    const Index b = finer.block(f);
    // The worst frames of the block.
    double place = 1, turn = 1;
    Index misplaced = -1, turned = -1;
    for (; f < take_.frames() && finer.block(f) == b; ++f) {
      const auto at = static_cast<std::size_t>(f);
      const double place_now = bounds_.place_ratio(source[at], decoded[at]);
      const double turn_now = bounds_.turn_ratio(source[at], decoded[at]);
      if (place_now > place) {
        place = place_now;
        misplaced = f;
      }
      if (turn_now > turn) {
        turn = turn_now;
        turned = f;
      }
    }
    if (misplaced >= 0) finer.add_miss(misplaced, place, quantiser_.shares(joint, misplaced));
    if (turned >= 0) finer.add_miss(turned, turn, quantiser_.shares_of_turn(joint, turned));
  }
}

void Refiner::find_pops(std::size_t joint, const PoseTrack& reached, FinerSteps& finer) const {
  for (Index f = 1; f < take_.frames(); ++f) {
    if (bounds_.pops(*take_.skeleton, quantiser_.source(), reached, joint,
                     static_cast<std::size_t>(f))) {
      finer.add_pop(joint, f);
    }
  }
}

bool Refiner::adapt(StepGrid& steps, bool stubborn, const PoseTrack& reached) const {
  FinerSteps finer(steps, stubborn);
  const std::size_t joints = take_.skeleton->joints.size();
  for (std::size_t j = 0; j < joints; ++j) find_misses(j, reached, finer);
  for (std::size_t j = 0; j < joints; ++j) {
    if (!take_.skeleton->joints[j].rotation_order.empty()) find_pops(j, reached, finer);
  }
  return finer.apply();
}

Refiner::Candidate Refiner::search(double step_mm, TimeScales scales) {
  Candidate result{empty_channels(scales), {}};
  quantiser_.set_steps(step_mm, result.coded.steps);
  for (int pass = 0; pass < most_passes; ++pass) {
    result.refinement.decoded = quantiser_.quantise(result.coded);
    if (adapt(result.coded.steps, pass >= stubborn_pass, quantiser_.decoded())) continue;
    finish(result);
    break;
  }
  return result;
}

bool Refiner::keeps_bounds(const ChannelMatrix& decoded) const {
  const Skeleton& skeleton = *take_.skeleton;
  const PoseTrack reached = pose_track(skeleton, decoded);
  for (std::size_t j = 0; j < reached.size(); ++j) {
    const std::vector<JointFrame>& source = quantiser_.source()[j];
    for (std::size_t f = 0; f < source.size(); ++f) {
      // What is no number keeps no bound.
      if (!(bounds_.place_ratio(source[f], reached[j][f]) <= 1 &&
            bounds_.turn_ratio(source[f], reached[j][f]) <= 1)) {
        return false;
      }
      if (f > 0 && bounds_.pops(skeleton, quantiser_.source(), reached, j, f)) return false;
    }
  }
  return true;
}

void Refiner::finish(Candidate& candidate) const {
  Refinement& refinement = candidate.refinement;
  if (!keeps_bounds(refinement.decoded)) return;
  refinement.bytes = candidate.coded.encode();
  refinement.contact_bytes = std::min(refinement.bytes.size(), candidate.coded.contact_bytes());
}

Refiner::Candidate Refiner::best_search() {
  const auto better = [](const Candidate& a, const Candidate& b) {
    const auto &own = a.refinement.bytes, &other = b.refinement.bytes;
    return !own.empty() && (other.empty() || own.size() < other.size());
  };
  TimeScales scales = time_scales(shape(), spans_s[0]);
  Candidate best = search(bounds_.mm() * starts[0], scales);
  for (const double span : std::span(spans_s).subspan(1)) {
    const TimeScales other = time_scales(shape(), span);
    if (other.levels == scales.levels) continue;
    Candidate found = search(bounds_.mm() * starts[0], other);
    if (!better(found, best)) continue;
    best = std::move(found);
    scales = other;
  }
  for (const double part : std::span(starts).subspan(1)) {
    Candidate found = search(bounds_.mm() * part, scales);
    if (better(found, best)) best = std::move(found);
  }
  for (double step = bounds_.mm(); best.refinement.bytes.empty() && step > bounds_.mm() / 1e4;
       step /= 2) {
    best = search(step, scales);
  }
  if (best.refinement.bytes.empty()) {
    best.coded = empty_channels(scales);
    std::fill(best.coded.steps.base.begin(), best.coded.steps.base.end(), -1);
    best.refinement.decoded = quantiser_.quantise(best.coded);
    finish(best);
    best.refinement.bytes = best.coded.encode();
  }
  return best;
}

void Refiner::hold_feet(Candidate& best) {
  const ContactFit fit(take_, quantiser_.source(), bounds_, best.coded, best.refinement);
  Candidate held{best.coded, {}};
  CodedChannels& coded = held.coded;
  coded.contacts = fit.choose();
  for (int pass = 0; pass < most_passes && !coded.contacts.intervals.empty(); ++pass) {
    held.refinement.decoded = quantiser_.quantise(coded);
    PoseTrack reached = quantiser_.decoded();
    fit.hold(coded, held.refinement.decoded, reached);
    if (pass >= cutting_pass && fit.cut(reached, bounds_, coded.contacts)) continue;
    if (adapt(coded.steps, pass >= stubborn_pass, reached)) continue;
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
