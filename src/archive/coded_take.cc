#include "archive/coded_take.h"

#include <utility>

#include "archive/survey.h"
#include "archive/take_layers.h"
#include "query/error_sketch.h"
#include "reprise/error.h"

namespace reprise {
namespace {

/// Bytes a frame for each channel (twists, numbers and knots, as they are and as they are decoded)
/// and for each joint (where it is and where it is decoded to).
constexpr std::size_t channel_bytes = 150, joint_bytes = 260;

std::vector<ClipRecord> clips_of(const FreshTake& fresh, const Take& take, const ClipPlan& plan) {
  const auto planned = plan.takes.find(fresh.file.name);
  if (planned == plan.takes.end()) return {whole_take_clip(fresh.outline.content, take.frames())};
  std::vector<ClipRecord> clips;
  for (const PlannedClip& part : planned->second) {
    ClipRecord clip = whole_take_clip(fresh.outline.content, part.frames);
    if (part.frames != take.frames()) {
      clip.id = clip_address(
          content_digest(*take.skeleton, take.channels, part.first_frame, part.frames));
    }
    clip.first_frame = part.first_frame;
    clip.group = part.group;
    clips.push_back(clip);
  }
  return clips;
}

TakeRecord make_record(const FreshTake& fresh, const Take& take, const SpaceAssignment& assignment,
                       const IngestOptions& options, TakeLayers coded) {
  TakeRecord record;
  record.layers = std::move(coded.layers);
  record.spent = std::move(coded.spent);
  record.error_quantiles = sketch_distances(coded.distances.places);
  record.turn_quantiles = sketch_distances(coded.distances.turns);
  record.proportions = assignment.proportions;
  record.space = assignment.space_id;
  TakeInfo& info = record.info;
  info.name = fresh.file.name;
  info.subject = fresh.metadata.subject.empty() ? fresh.outline.subject : fresh.metadata.subject;
  info.description = fresh.metadata.description;
  info.tags = fresh.metadata.tags;
  info.frames = take.frames();
  info.fidelity = options.fidelity;
  info.text_bytes = fresh.outline.text_bytes;
  info.error_mm = coded.errors.places;
  info.rotation_deg = coded.errors.turns;
  info.worst_place = coded.errors.worst_place;
  info.worst_turn = coded.errors.worst_turn;
  info.source_digest = fresh.outline.source_digest;
  return record;
}

/// Whether a take that cannot be coded on its space is stored all the same: its text holds
/// everything. What markers do not carry is tried channel by channel before.
bool by_text_alone(const CodedSpace& space, const IngestOptions& options) {
  return options.fidelity.tier == FidelityTier::exact &&
         !space.space.layout.choices.through_markers;
}

}  // namespace

std::size_t CodedTake::bytes() const {
  std::size_t bytes = 0;
  for (const LayerRecord& layer : record.layers) bytes += layer.data.size();
  return bytes;
}

std::size_t coding_memory(const Skeleton& skeleton, long frames) {
  const std::size_t a_frame = channel_bytes * static_cast<std::size_t>(skeleton.channel_count) +
                              joint_bytes * skeleton.joints.size();
  return static_cast<std::size_t>(frames) * a_frame;
}

CodedTake code_take(const FreshTake& fresh, const SpaceAssignment& assignment, const ClipPlan& plan,
                    const IngestOptions& options) {
  CodedTake coded;
  try {
    const auto [take, text] = read_source(fresh, options.read);
    const PreparedTake prepared = prepare_take(take);
    FittedTake fitted = assignment.fitted
                            ? *assignment.fitted
                            : fit_take(assignment.space->space, assignment.space->model, prepared,
                                       fit_options(options));
    coded.kept = fitted.kept || by_text_alone(*assignment.space, options);
    if (!coded.kept) return coded;
    coded.record = make_record(
        fresh, take, assignment, options,
        make_layers(options, *assignment.space, {take, prepared, text}, std::move(fitted)));
    coded.clips = clips_of(fresh, take, plan);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::rejected_input && error.code() != ErrorCode::limit) throw;
    coded.rejected = rejection(fresh.file, error);
  }
  return coded;
}

}  // namespace reprise
