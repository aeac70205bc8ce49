#include "archive/space_builder.h"

#include <algorithm>

#include "archive/kind_choice.h"
#include "archive/parallel.h"
#include "query/stored_forms.h"
#include "reprise/error.h"
#include "store/digest.h"

namespace reprise {
namespace {

/// Axes are learned from at most this many takes of a skeleton, evenly spread over their names, and
/// the coder's contexts from at most this many frames.
constexpr std::size_t most_training_takes = 1000;
constexpr long most_context_frames = 60000;

std::vector<std::size_t> spread(const std::vector<std::size_t>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(all[i * all.size() / most]);
  return some;
}

SkeletonRecord skeleton_record(const Skeleton& skeleton, const Digest& structure) {
  SkeletonRecord record;
  record.structure = structure;
  record.format = skeleton.format;
  record.joints = skeleton.joints.size();
  record.channels = static_cast<std::size_t>(skeleton.channel_count);
  record.root = skeleton.joints.front().name;
  return record;
}

}  // namespace

std::map<std::string, SpaceAssignment> SpaceBuilder::build(
    const std::vector<FreshTake>& takes, const std::function<void(const std::string&)>& tick) {
  takes_ = &takes;
  tick_ = tick;
  if (takes.empty()) return {};
  std::map<std::string, Members> by_structure;
  std::vector<std::string> order;
  for (std::size_t i = 0; i < takes.size(); ++i) {
    const std::string structure = structure_bytes(*takes[i].outline.skeleton);
    if (!by_structure.contains(structure)) order.push_back(structure);
    by_structure[structure].push_back(i);
  }
  // Each skeleton on its own: a stopped ingest keeps those that are done.
  for (const std::string& structure : order) {
    store_.begin();
    build_for_skeleton(by_structure.at(structure));
    store_.commit();
  }
  return std::move(assignments_);
}

std::int64_t SpaceBuilder::skeleton_of(const Members& members) {
  const Skeleton& first = *(*takes_)[members.front()].outline.skeleton;
  const Digest structure = digest_of(structure_bytes(first));
  const auto known = store_.find_skeleton(structure);
  return known ? known->id : store_.add_skeleton(skeleton_record(first, structure));
}

void SpaceBuilder::assign_proportions(std::int64_t skeleton, const Members& members) {
  for (const std::size_t i : members) {
    const TakeOutline& outline = (*takes_)[i].outline;
    ProportionsRecord record = proportions_record(*outline.skeleton, outline.layout,
                                                  outline.frame_rate, outline.frame_rate_assumed);
    record.skeleton = skeleton;
    const auto known = store_.find_proportions(record);
    assignments_[(*takes_)[i].file.name].proportions =
        known ? *known : store_.add_proportions(record);
  }
}

void SpaceBuilder::build_for_skeleton(const Members& members) {
  const std::int64_t skeleton = skeleton_of(members);
  assign_proportions(skeleton, members);
  const std::int64_t known = newest_space(skeleton);
  if (known == 0) {
    const SpaceRecord record = train(skeleton, members);
    const std::int64_t id = store_.add_space(record);
    assign_space(id, members);
    keep_fits(id);
  } else {
    assign_space(known, members);
  }
  extend_where_needed(skeleton, members);
}

std::int64_t SpaceBuilder::newest_space(std::int64_t skeleton) {
  std::vector<std::int64_t> spaces = store_.spaces_of_skeleton(skeleton);
  for (; !spaces.empty(); spaces.pop_back()) {
    if (read_space(store_, spaces.back()).space.layout.choices.through_markers)
      return spaces.back();
  }
  return 0;
}

void SpaceBuilder::assign_space(std::int64_t id, const Members& members) {
  const auto space = std::make_shared<const CodedSpace>(read_space(store_, id));
  for (const std::size_t i : members) {
    SpaceAssignment& assignment = assignments_[(*takes_)[i].file.name];
    assignment.space_id = id;
    assignment.space = space;
  }
}

MarkerMoments SpaceBuilder::moments_of(const MarkerLayout& layout, const Members& members,
                                       bool every_frame) {
  MarkerMoments moments;
  produce_in_order(
      members.size(), options_.jobs,
      [&](std::size_t m) {
        MarkerMoments own;
        const Take take = read_again((*takes_)[members[m]], options_.read);
        own.add(every_frame ? mark_take(layout, take).markers : sampled_markers(layout, take));
        return own;
      },
      [&](std::size_t, MarkerMoments own) { moments.add(own); });
  return moments;
}

SpaceRecord SpaceBuilder::train(std::int64_t skeleton, const Members& members) {
  const double mean_mm = coarse_mean_mm(options_.fidelity);
  const Skeleton reference = reference_skeleton(store_, skeleton);
  const Members training = spread(members, most_training_takes);
  LayoutEvidence evidence;
  for (const std::size_t i : training) evidence.add((*takes_)[i].outline.evidence);
  MarkerLayout layout = make_marker_layout(reference, choose_layout(reference, evidence));
  const MarkerMoments moments = moments_of(layout, training, false);
  const CoefficientSpace space = train_space(std::move(layout), moments, evidence, mean_mm);
  const auto bytes = encode_space(space, space_precision(space, mean_mm));
  // From here on everything is as the decoder sees it.
  const CoefficientSpace decoded = decode_space(bytes, reference, nullptr);
  const auto prior = train_prior(decoded, training, members.size());
  return {0, skeleton, 0, pack_space(bytes, prior)};
}

std::vector<std::uint8_t> SpaceBuilder::train_prior(const CoefficientSpace& space,
                                                    const Members& training, std::size_t all) {
  long frames = 0;
  for (const std::size_t i : training) frames += (*takes_)[i].outline.frames;
  const double part =
      std::min(1.0, static_cast<double>(most_context_frames) / static_cast<double>(frames));
  const Members chosen = spread(
      training, std::max<std::size_t>(
                    1, static_cast<std::size_t>(part * static_cast<double>(training.size()))));
  const double takes_each = static_cast<double>(all) / static_cast<double>(chosen.size());
  const KnotScales scales = measure_scales(space, chosen, takes_each);
  const KnotModel model(scales);
  fits_.clear();
  produce_in_order(
      chosen.size(), options_.jobs,
      [&](std::size_t c) {
        const Take take = read_again((*takes_)[chosen[c]], options_.read);
        return fit_take(space, model, take, fit_options(options_));
      },
      [&](std::size_t c, FittedTake fitted) {
        if (fitted.kept) fits_.emplace(chosen[c], std::move(fitted));
        tick_((*takes_)[chosen[c]].file.name);
      });
  return cheaper_prior(scales, takes_each);
}

KnotScales SpaceBuilder::measure_scales(const CoefficientSpace& space, const Members& members,
                                        double takes_each) {
  KnotScales scales;
  std::vector<TakeCurves> curves;
  produce_in_order(
      members.size(), options_.jobs,
      [&](std::size_t m) {
        const Take take = read_again((*takes_)[members[m]], options_.read);
        const MarkedTake marked = mark_take(space.layout, take);
        return TakeCurves{{take.frames(), take.frame_rate},
                          marked.root.tumbles,
                          to_trajectories(space, take, marked)};
      },
      [&](std::size_t, TakeCurves one) {
        add_scales(space, one, scales);
        curves.push_back(std::move(one));
      });
  scales.settle();
  KindCosts costs;
  const KnotModel model(scales);
  const int step = guessed_step(coarse_mean_mm(options_.fidelity));
  produce_in_order(
      curves.size(), options_.jobs,
      [&](std::size_t c) { return kind_costs(space, model, curves[c], step); },
      [&](std::size_t, const KindCosts& own) { costs.add(own, takes_each); });
  return costs.cheapest(scales);
}

std::vector<std::uint8_t> SpaceBuilder::cheaper_prior(const KnotScales& scales,
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

void SpaceBuilder::keep_fits(std::int64_t space) {
  for (auto& [i, fitted] : fits_) {
    SpaceAssignment& assignment = assignments_[(*takes_)[i].file.name];
    if (assignment.space_id == space) assignment.fitted = std::move(fitted);
  }
  fits_.clear();
}

void SpaceBuilder::extend_where_needed(std::int64_t skeleton, const Members& members) {
  const std::int64_t base_id = assignments_.at((*takes_)[members.front()].file.name).space_id;
  const auto base = assignments_.at((*takes_)[members.front()].file.name).space;
  const double most = FitConstants::most_residual * coarse_mean_mm(options_.fidelity);
  Members unfit;
  produce_in_order(
      members.size(), options_.jobs,
      [&](std::size_t m) {
        const FreshTake& fresh = (*takes_)[members[m]];
        if (assignments_.at(fresh.file.name).fitted) return false;
        const Take take = read_again(fresh, options_.read);
        return residual_mm(base->space, mark_take(base->space.layout, take).markers) > most;
      },
      [&](std::size_t m, bool unfits) {
        if (unfits) unfit.push_back(members[m]);
      });
  if (unfit.empty()) return;
  const double mean_mm = coarse_mean_mm(options_.fidelity);
  const MarkerMoments moments = moments_of(base->space.layout, unfit, true);
  const CoefficientSpace space = extend_space(base->space, moments, mean_mm);
  const int known = static_cast<int>(base->space.axes.cols());
  if (space.axes.cols() == known) return;
  const auto bytes = encode_extension(space, known, space_precision(space, mean_mm));
  SpaceRecord record{0, skeleton, base_id, {}};
  record.data =
      pack_space(bytes, train_prior(decode_space(bytes, base->space.layout.reference, &base->space),
                                    unfit, unfit.size()));
  const std::int64_t id = store_.add_space(record);
  assign_space(id, unfit);
  keep_fits(id);
}

std::map<std::string, SpaceAssignment> SpaceBuilder::build_plain(
    const std::vector<FreshTake>& takes,
    const std::map<std::string, SpaceAssignment>& assignments) {
  takes_ = &takes;
  assignments_.clear();
  store_.begin();
  for (std::size_t i = 0; i < takes.size(); ++i) {
    const std::string& name = takes[i].file.name;
    assignments_[name] = assignments.at(name);
    const std::int64_t skeleton = store_.space(assignments_[name].space_id).skeleton;
    assign_space(plain_space(skeleton), {i});
    assignments_[name].fitted.reset();
  }
  store_.commit();
  return std::move(assignments_);
}

std::int64_t SpaceBuilder::plain_space(std::int64_t skeleton) {
  const Skeleton reference = reference_skeleton(store_, skeleton);
  CoefficientSpace space;
  LayoutChoices choices;
  choices.active.assign(static_cast<std::size_t>(reference.channel_count), false);
  choices.through_markers = false;
  space.layout = make_marker_layout(reference, choices);
  space.mean.resize(0);
  space.axes.resize(0, 0);
  space.variance.resize(0);
  space.start.assign(choices.active.size(), 0.0);
  const SpaceRecord record{0, skeleton, 0,
                           pack_space(encode_space(space, {}), KnotModel().prior(false))};
  for (const std::int64_t id : store_.spaces_of_skeleton(skeleton)) {
    if (store_.space(id).data == record.data) return id;
  }
  return store_.add_space(record);
}

}  // namespace reprise
