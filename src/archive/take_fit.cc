#include "archive/take_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contacts/contact_choice.h"
#include "quant/coarsest_step.h"

namespace reprise {
namespace {

/// Codes one take at one step after another.
class StepSearch {
 public:
  StepSearch(const CoefficientSpace& space, const KnotModel& model, const PreparedTake& prepared,
             const FitOptions& options)
      : space_(space),
        model_(model),
        take_(prepared.take),
        constants_(prepared.header.constants),
        allowed_(options.mean_mm * (1.0 - FitConstants::margin)),
        holds_feet_(options.contacts),
        positions_(joint_positions(*take_.skeleton, take_.channels)) {
    MarkedTake marked = mark_take(space.layout, take_);
    TrajectoryMatrix trajectories = to_trajectories(space, take_, marked, constants_);
    choose_kinds({take_.frames(), take_.frame_rate}, marked.root.tumbles, trajectories);
    find_switches();
  }

  FittedTake run() {
    FittedTake best = search(first_guess());
    if (best.kept && holds_change(best.motion)) best = search(best.motion.step_index);
    if (best.kept || contacts_.intervals.empty()) return best;
    // What the source's feet slide may be more than the error that is allowed.
    contacts_ = {};
    return search(first_guess());
  }

 private:
  /// The coarsest step that keeps the mean.
  FittedTake search(int step) {
    FittedTake best;
    const StepRange range{QuantiserConstants::most_step, QuantiserConstants::steps_per_octave,
                          step};
    const int found = coarsest_step(range, allowed_, [&](int index) {
      FittedTake tried = measure(index);
      const double mean = tried.mean_mm;
      if (mean <= allowed_) best = std::move(tried);
      return mean;
    });
    best.kept = found >= 0;
    return best;
  }

  int first_guess() const { return guessed_step(allowed_); }

  void choose_kinds(const TakeShape& shape, bool tumbles, const TrajectoryMatrix& trajectories) {
    double least = std::numeric_limits<double>::infinity();
    const std::vector<CurveKinds> possible = possible_kinds(model_, shape.frames);
    for (const CurveKinds kinds : possible) {
      TakeKnots knots = take_knots(space_, shape, tumbles, trajectories, kinds);
      const double cost = possible.size() == 1 ? 0 : quantise(model_, knots, first_guess()).cost;
      if (cost >= least) continue;
      least = cost;
      knots_ = std::move(knots);
      kinds_ = kinds;
    }
  }

  ChannelMatrix decode(const CodedMotion& motion) const {
    return motion_channels(space_, *take_.skeleton, constants_, {take_.frames(), take_.frame_rate},
                           motion);
  }

  void find_switches() {
    const int step = first_guess();
    CodedMotion motion{knots_.tumbles, step, kinds_, {}, quantise(model_, knots_, step).knots, {}};
    switches_ = find_branch_switches(space_, take_, decode(motion));
    motion.switches = switches_;
    holds_change(std::move(motion));
  }

  /// Chooses contacts for what a motion is without them; true if they are not those from before.
  bool holds_change(CodedMotion motion) {
    if (!holds_feet_) return false;
    motion.contacts = {};
    TakeContacts chosen = choose_contacts(*take_.skeleton, find_legs(space_.layout.reference),
                                          take_.frame_rate, positions_, decode(motion));
    const bool changed = chosen != contacts_;
    contacts_ = std::move(chosen);
    return changed;
  }

  FittedTake measure(int step) const {
    FittedTake tried;
    tried.shape = knots_.shape;
    tried.shape.step_half_octaves = half_octaves(step);
    tried.motion = {knots_.tumbles, step, kinds_, switches_, quantise(model_, knots_, step).knots,
                    contacts_};
    const PositionMatrix decoded = joint_positions(*take_.skeleton, decode(tried.motion));
    const std::vector<float> distances = joint_distances(positions_, decoded);
    double sum = 0;
    for (const float distance : distances) sum += distance;
    tried.mean_mm = distances.empty() ? 0 : sum / static_cast<double>(distances.size());
    return tried;
  }

  const CoefficientSpace& space_;
  const KnotModel& model_;
  const Take& take_;
  const ChannelConstants& constants_;
  double allowed_;
  bool holds_feet_;
  PositionMatrix positions_;
  TakeKnots knots_;
  CurveKinds kinds_;
  std::vector<BranchSwitch> switches_;
  TakeContacts contacts_;
};

}  // namespace

int guessed_step(double mean_mm) {
  // A coefficient takes its share of all points' error; see docs/findings for the factor.
  return step_index_of(FitConstants::step_per_millimetre * mean_mm);
}

double residual_mm(const CoefficientSpace& space, const MarkerMatrix& markers) {
  const MarkerMatrix centred = markers.rowwise() - space.mean.transpose();
  const double all = centred.squaredNorm();
  const double inside = (centred * space.axes).squaredNorm();
  return std::sqrt(
      std::max(all - inside, 0.0) /
      (static_cast<double>(std::max<Eigen::Index>(markers.rows(), 1)) * space.layout.point_count));
}

double coarse_mean_mm(const Fidelity& fidelity) {
  return fidelity.tier == FidelityTier::preview ? fidelity.limit_mm
                                                : FidelityLimits::preview_mean_mm;
}

FitOptions fit_options(const IngestOptions& options) {
  return {coarse_mean_mm(options.fidelity), options.contacts};
}

FittedTake fit_take(const CoefficientSpace& space, const KnotModel& model,
                    const PreparedTake& prepared, const FitOptions& options) {
  return StepSearch(space, model, prepared, options).run();
}

}  // namespace reprise
