#include "archive/space_builder.h"

#include <algorithm>

#include "archive/parallel.h"
#include "query/stored_forms.h"
#include "reprise/error.h"
#include "store/digest.h"

namespace reprise {
namespace {

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
  SpaceTrainer trainer(takes, options_, tick);
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
    build_for_skeleton(by_structure.at(structure), trainer);
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

void SpaceBuilder::build_for_skeleton(const Members& members, SpaceTrainer& trainer) {
  const std::int64_t skeleton = skeleton_of(members);
  assign_proportions(skeleton, members);
  if ((*takes_)[members.front()].outline.skeleton->joints.size() > TrainingConstants::most_joints) {
    assign_space(plain_space(skeleton), members);
    return;
  }
  std::int64_t space = newest_space(skeleton);
  if (space == 0) {
    const Skeleton reference = reference_skeleton(store_, skeleton);
    space = store_.add_space({0, skeleton, 0, trainer.train(reference, members)});
  }
  assign_space(space, members);
  assign_fits(trainer);
  const Members unfit = members_outside(members);
  if (unfit.empty()) return;
  const auto base = assignments_.at((*takes_)[unfit.front()].file.name).space;
  Bytes extension = trainer.extend(*base, unfit);
  if (extension.empty()) return;
  assign_space(store_.add_space({0, skeleton, space, std::move(extension)}), unfit);
  assign_fits(trainer);
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

void SpaceBuilder::assign_fits(SpaceTrainer& trainer) {
  for (auto& [i, fitted] : trainer.take_fits())
    assignments_[(*takes_)[i].file.name].fitted = std::move(fitted);
}

SpaceBuilder::Members SpaceBuilder::members_outside(const Members& members) const {
  const double most = FitConstants::most_residual * coarse_mean_mm(options_.fidelity);
  Members unfit;
  produce_in_order(
      members.size(), options_.jobs,
      [&](std::size_t m) {
        const FreshTake& fresh = (*takes_)[members[m]];
        const SpaceAssignment& assignment = assignments_.at(fresh.file.name);
        if (assignment.fitted) return false;
        const CoefficientSpace& space = assignment.space->space;
        const Take take = read_prepared(fresh, options_.read).take;
        return residual_mm(space, mark_take(space.layout, take).markers) > most;
      },
      [&](std::size_t m, bool unfits) {
        if (unfits) unfit.push_back(members[m]);
        tick_({});
      });
  return unfit;
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
                           pack_space({}, encode_space(space, {}), KnotModel().prior(false))};
  for (const std::int64_t id : store_.spaces_of_skeleton(skeleton)) {
    if (store_.space(id).data == record.data) return id;
  }
  return store_.add_space(record);
}

}  // namespace reprise
