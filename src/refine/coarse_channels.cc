#include "refine/coarse_channels.h"

#include <algorithm>
#include <cmath>

#include "contacts/contact_choice.h"
#include "contacts/contact_stage.h"
#include "quant/coarsest_step.h"
#include "refine/channel_quantiser.h"
#include "reprise/model/kinematics.h"
#include "reprise/model/measure.h"

namespace reprise {
namespace {

/// Indices of steps: step_one is a step of 1 mm.
constexpr int steps_per_octave = 32, step_one = 320, most_step = 1023;
/// The step for a millimetre of mean error, about, and how large displacements are that the
/// quantiser expects (docs/findings/2026-11-26-coarse-channels.md).
constexpr double step_per_millimetre = 3, reach_per_millimetre = 3;
/// Seconds between the coarsest knots.
constexpr double spans_s[] = {1.06, 2.12};
/// The arm (mm) that holds turns that move nothing, times the root of the reach (mm), as in
/// Refiner.
constexpr double arm_at_one_mm = 20;
/// A take in fewer bytes than this for each channel that moves is not looked at: postures alone
/// would take more.
constexpr std::size_t least_channel_bytes = 4;
/// Bytes times mean error changes by less than this while a step is searched for.
constexpr double hope = 1.3;
/// A step is kept only if the mean is this much below what was promised (part of it), for decimals
/// of a file and other machines' sines.
constexpr double margin = 1e-4;
/// Times that contacts are chosen.
constexpr int contact_rounds = 2;

double step_mm(int index) {
  return std::exp2(static_cast<double>(index - step_one) / steps_per_octave);
}

class CoarseSearch {
 public:
  CoarseSearch(const PreparedTake& prepared, const CoarseOptions& options)
      : prepared_(prepared),
        take_(prepared.take),
        options_(options),
        allowed_(options.mean_mm * (1 - margin)),
        positions_(joint_positions(*take_.skeleton, take_.channels)),
        quantiser_(prepared, arm_at_one_mm * std::sqrt(reach_per_millimetre * options.mean_mm)) {}

  std::optional<Refinement> run() {
    int step =
        step_one + static_cast<int>(std::lround(steps_per_octave *
                                                std::log2(step_per_millimetre * options_.mean_mm)));
    if (!choose_span(step)) return std::nullopt;
    std::optional<Candidate> best = search(step);
    if (!best || best->bytes.size() > options_.most_bytes) return std::nullopt;
    // Chosen again at the step that is found.
    for (int round = 0; options_.contacts && round < contact_rounds; ++round) {
      if (!holds_change(*best)) break;
      std::optional<Candidate> held = search(best->step);
      // What the source's feet slide may be more than the error that is allowed.
      if (!held) break;
      best = std::move(held);
    }
    if (best->bytes.size() > options_.most_bytes) return std::nullopt;
    const std::size_t contact_bytes = std::min(best->bytes.size(), best->coded.contact_bytes());
    return Refinement{std::move(best->bytes), std::move(best->decoded), contact_bytes};
  }

 private:
  struct Candidate {
    CodedChannels coded;
    ChannelMatrix decoded;
    int step = 0;
    double mean_mm = 0;
    std::vector<std::uint8_t> bytes;
  };

  Candidate measure(int step, TimeScales scales) {
    const TakeShape shape{take_.frames(), take_.frame_rate};
    Candidate tried{
        CodedChannels(*take_.skeleton, prepared_.header.constants, shape, scales), {}, step, 0, {}};
    quantiser_.set_steps(step_mm(step), tried.coded.steps);
    tried.decoded = quantiser_.quantise(tried.coded);
    PositionMatrix reached = positions_of(quantiser_.decoded());
    if (!contacts_.intervals.empty()) {
      tried.coded.contacts = contacts_;
      tried.coded.hold_feet(*take_.skeleton, tried.decoded);
      reached = joint_positions(*take_.skeleton, tried.decoded);
    }
    const auto distances = joint_distances(positions_, reached);
    for (const float distance : distances) tried.mean_mm += distance;
    tried.mean_mm /= static_cast<double>(std::max<std::size_t>(1, distances.size()));
    return tried;
  }

  /// Chooses contacts for what a candidate is without them; true if they are not those from before.
  bool holds_change(const Candidate& candidate) {
    TakeContacts chosen =
        choose_contacts(*take_.skeleton, candidate.coded.legs, take_.frame_rate, positions_,
                        candidate.coded.trajectories(*take_.skeleton));
    const bool change = chosen != contacts_;
    contacts_ = std::move(chosen);
    return change;
  }

  /// The span with which bytes and error are least at a step; false: both are too large to hope for
  /// `most_bytes`.
  bool choose_span(int step) {
    double least = hope * static_cast<double>(options_.most_bytes) * options_.mean_mm;
    bool found = false;
    for (const double span : spans_s) {
      const TimeScales scales = time_scales({take_.frames(), take_.frame_rate}, span);
      if (found && scales == scales_) continue;
      const Candidate tried = measure(step, scales);
      const double cost = static_cast<double>(tried.coded.encode().size()) * tried.mean_mm;
      if (!(cost < least)) continue;
      least = cost;
      scales_ = scales;
      found = true;
    }
    return found;
  }

  std::optional<Candidate> search(int first) {
    std::optional<Candidate> best;
    coarsest_step({most_step, steps_per_octave, first}, allowed_, [&](int step) {
      Candidate tried = measure(step, scales_);
      const double mean = tried.mean_mm;
      if (mean <= allowed_) best = std::move(tried);
      return mean;
    });
    if (best) best->bytes = best->coded.encode();
    return best;
  }

  const PreparedTake& prepared_;
  const Take& take_;
  const CoarseOptions& options_;
  double allowed_;
  PositionMatrix positions_;
  ChannelQuantiser quantiser_;
  TimeScales scales_;
  TakeContacts contacts_;
};

}  // namespace

std::optional<Refinement> coarse_channels(const PreparedTake& prepared,
                                          const CoarseOptions& options) {
  const std::size_t moving = moving_count(prepared.header.constants);
  if (prepared.take.frames() == 0 || options.most_bytes < least_channel_bytes * moving)
    return std::nullopt;
  return CoarseSearch(prepared, options).run();
}

ChannelMatrix decode_coarse_channels(const Skeleton& skeleton, const ChannelConstants& constants,
                                     const TakeShape& shape, std::span<const std::uint8_t> bytes) {
  const CodedChannels coded = CodedChannels::decode(skeleton, constants, shape, bytes);
  ChannelMatrix channels = coded.trajectories(skeleton);
  coded.hold_feet(skeleton, channels);
  return channels;
}

}  // namespace reprise
