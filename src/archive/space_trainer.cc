#include "archive/space_trainer.h"

#include <algorithm>

#include "archive/parallel.h"
#include "quant/known_values.h"

namespace reprise {
namespace {

/// Axes are learned from at most this many takes of a skeleton, evenly spread over their names, and
/// the coder's contexts from at most this many frames.
constexpr std::size_t most_training_takes = 1000;
constexpr long most_context_frames = 60000;
/// How fine axes are is decided by the curves of about so many frames.
constexpr long most_precision_frames = 6000;
/// What curves take up in the end, of what they cost, error included, at the step that the search
/// for one begins with: 0.17 to 0.3 of it, by the libraries of docs/findings/2026-11-26-axes.md.
constexpr double bits_of_cost = 0.24;

std::vector<std::size_t> spread(const std::vector<std::size_t>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(all[i * all.size() / most]);
  return some;
}

}  // namespace

Bytes SpaceTrainer::train(const Skeleton& reference, const Members& members) {
  const double mean_mm = coarse_mean_mm(options_.fidelity);
  const Members training = spread(members, most_training_takes);
  LayoutEvidence evidence;
  for (const std::size_t i : training) evidence.add(takes_[i].outline.evidence);
  MarkerLayout layout = make_marker_layout(reference, choose_layout(reference, evidence));
  const MarkerMoments moments = moments_of(layout, training, false);
  CoefficientSpace space = train_space(std::move(layout), moments, evidence, mean_mm);
  space.known = evidence.values.known_values(static_cast<std::size_t>(reference.channel_count));
  const auto bytes = encode_space(space, precision_for(space, 0, members));
  // From here on everything is as the decoder sees it.
  CoefficientSpace decoded = decode_space(bytes, reference, nullptr);
  set_known_values(space.known, decoded);
  const auto prior = train_prior(decoded, training, members.size());
  return pack_space(encode_known_values(space.known), bytes, prior);
}

Bytes SpaceTrainer::extend(const CodedSpace& base, const Members& unfit) {
  const double mean_mm = coarse_mean_mm(options_.fidelity);
  const MarkerMoments moments = moments_of(base.space.layout, unfit, true);
  const CoefficientSpace space = extend_space(base.space, moments, mean_mm);
  const int known = static_cast<int>(base.space.axes.cols());
  if (space.axes.cols() == known) return {};
  const auto bytes = encode_extension(space, known, precision_for(space, known, unfit));
  // From here on everything is as the decoder sees it.
  const CoefficientSpace decoded = decode_space(bytes, base.space.layout.reference, &base.space);
  return pack_space({}, bytes, train_prior(decoded, unfit, unfit.size()));
}

MarkerMoments SpaceTrainer::moments_of(const MarkerLayout& layout, const Members& members,
                                       bool every_frame) const {
  MarkerMoments moments;
  produce_in_order(
      members.size(), options_.jobs,
      [&](std::size_t m) {
        MarkerMoments own;
        const Take take = read_prepared(takes_[members[m]], options_.read).take;
        own.add(every_frame ? mark_take(layout, take).markers : sampled_markers(layout, take));
        return own;
      },
      [&](std::size_t, MarkerMoments own) {
        moments.add(own);
        tick_({});
      });
  return moments;
}

long SpaceTrainer::frames_of(const Members& members) const {
  long frames = 0;
  for (const std::size_t i : members) frames += takes_[i].outline.frames;
  return frames;
}

SpaceTrainer::Members SpaceTrainer::some_of(const Members& members, long most_frames) const {
  const auto count = static_cast<double>(members.size());
  const double part = std::min(1.0, static_cast<double>(most_frames) /
                                        std::max(1.0, static_cast<double>(frames_of(members))));
  return spread(members, std::max<std::size_t>(1, static_cast<std::size_t>(part * count)));
}

SpacePrecision SpaceTrainer::precision_for(const CoefficientSpace& space, Eigen::Index known,
                                           const Members& members) const {
  const Members some = some_of(members, most_precision_frames);
  const double each =
      static_cast<double>(frames_of(members)) / std::max(1.0, static_cast<double>(frames_of(some)));
  const double bits = bits_of_cost * std::ranges::min(measure_curves(space, some, each).costs.bits);
  const auto entries = static_cast<double>(space.layout.dimensions() * (space.axes.cols() - known));
  return space_precision(space, coarse_mean_mm(options_.fidelity), axis_share(entries, bits));
}

std::vector<std::uint8_t> SpaceTrainer::train_prior(const CoefficientSpace& space,
                                                    const Members& training, std::size_t all) {
  const Members chosen = some_of(training, most_context_frames);
  const double takes_each = static_cast<double>(all) / static_cast<double>(chosen.size());
  const MeasuredCurves curves = measure_curves(space, chosen, takes_each);
  const KnotScales scales = curves.costs.cheapest(curves.scales);
  const KnotModel model(scales);
  fits_.clear();
  produce_in_order(
      chosen.size(), options_.jobs,
      [&](std::size_t c) {
        const PreparedTake prepared = read_prepared(takes_[chosen[c]], options_.read);
        return fit_take(space, model, prepared, fit_options(options_));
      },
      [&](std::size_t c, FittedTake fitted) {
        if (fitted.kept) fits_.emplace(chosen[c], std::move(fitted));
        tick_(takes_[chosen[c]].file.name);
      });
  return cheaper_prior(scales, takes_each);
}

SpaceTrainer::MeasuredCurves SpaceTrainer::measure_curves(const CoefficientSpace& space,
                                                          const Members& members,
                                                          double takes_each) const {
  MeasuredCurves measured;
  std::vector<TakeCurves> curves;
  produce_in_order(
      members.size(), options_.jobs,
      [&](std::size_t m) {
        const PreparedTake prepared = read_prepared(takes_[members[m]], options_.read);
        const Take& take = prepared.take;
        const MarkedTake marked = mark_take(space.layout, take);
        return TakeCurves{{take.frames(), take.frame_rate},
                          marked.root.tumbles,
                          to_trajectories(space, take, marked, prepared.header.constants)};
      },
      [&](std::size_t, TakeCurves one) {
        add_scales(space, one, measured.scales);
        curves.push_back(std::move(one));
        tick_({});
      });
  measured.scales.settle();
  const KnotModel model(measured.scales);
  const int step = guessed_step(coarse_mean_mm(options_.fidelity));
  produce_in_order(
      curves.size(), options_.jobs,
      [&](std::size_t c) { return kind_costs(space, model, curves[c], step); },
      [&](std::size_t, const KindCosts& own) {
        measured.costs.add(own, takes_each);
        tick_({});
      });
  return measured;
}

std::vector<std::uint8_t> SpaceTrainer::cheaper_prior(const KnotScales& scales,
                                                      double takes_each) const {
  KnotModel learned(scales);
  learned.learn_in_common();
  for (const auto& [i, fitted] : fits_) learned.learn(fitted.shape, fitted.motion.knots);
  const auto bits = [&](const std::vector<std::uint8_t>& prior) {
    KnotModel start;
    start.load_prior(prior);
    double sum = 0;
    for (const auto& [i, fitted] : fits_)
      sum += KnotModel(start).learn(fitted.shape, fitted.motion.knots);
    return takes_each * sum + 8.0 * static_cast<double>(prior.size());
  };
  auto with = learned.prior(true), without = learned.prior(false);
  return bits(with) < bits(without) ? with : without;
}

}  // namespace reprise
