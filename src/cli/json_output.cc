#include "cli/json_output.h"

namespace reprise::cli {
namespace {

double ratio(std::uint64_t larger, std::uint64_t smaller) {
  return smaller == 0 ? 0 : static_cast<double>(larger) / static_cast<double>(smaller);
}

}  // namespace

std::string format_name(MotionFormat format) { return format == MotionFormat::bvh ? "bvh" : "amc"; }

Json to_json(const PositionErrors& errors) {
  return {{"mean", errors.mean}, {"rms", errors.rms}, {"p99", errors.p99}, {"max", errors.max}};
}

Json to_json(const RotationErrors& errors) {
  return {{"mean", errors.mean}, {"p99", errors.p99}, {"max", errors.max}};
}

std::string joint_label(const Skeleton& skeleton, int joint) {
  if (joint < 0 || static_cast<std::size_t>(joint) >= skeleton.joints.size()) return {};
  const Joint& at = skeleton.joints[static_cast<std::size_t>(joint)];
  if (!at.end_site || at.parent < 0) return at.name;
  return "end site of " + skeleton.joints[static_cast<std::size_t>(at.parent)].name;
}

Json worst_json(const Skeleton& skeleton, const JointAt& at, double frame_rate) {
  return {{"joint", joint_label(skeleton, at.joint)},
          {"frame", at.frame},
          {"time", static_cast<double>(at.frame) / frame_rate}};
}

Json to_json(const std::vector<Damage>& damaged) {
  Json entries = Json::array();
  for (const Damage& damage : damaged) entries.push_back({{"id", damage.id}, {"why", damage.why}});
  return entries;
}

Json to_json(const TakeInfo& take) {
  // The row number means nothing outside this archive; what names a take is its name.
  return {{"id", take.name},
          {"name", take.name},
          {"subject", take.subject},
          {"format", format_name(take.format)},
          {"frames", take.frames},
          {"frame_rate", take.frame_rate},
          {"seconds", take.seconds()},
          {"unit_mm", take.unit_mm},
          {"unit_assumed", take.unit_assumed},
          {"up", up_axis_name(take.up)},
          {"up_assumed", take.up_assumed},
          {"fidelity", tier_name(take.fidelity.tier)},
          {"raw_bytes", take.raw_bytes},
          {"payload_bytes", take.payload_bytes},
          {"error_mm", to_json(take.error_mm)},
          {"rotation_deg", to_json(take.rotation_deg)},
          {"limit_mm", take.fidelity.limit_mm},
          {"limit_deg", take.fidelity.limit_deg}};
}

Json to_json(const TakeInfo& take, const Skeleton& skeleton) {
  Json fields = to_json(take);
  fields["worst_place"] = worst_json(skeleton, take.worst_place, take.frame_rate);
  fields["worst_turn"] = worst_json(skeleton, take.worst_turn, take.frame_rate);
  return fields;
}

Json to_json(const ClipInfo& clip) {
  Json json = {{"id", clip.id},
               {"take", clip.take},
               {"kind", clip_kind_name(clip.kind)},
               {"group", clip.group},
               {"start", clip.start},
               {"end", clip.end},
               {"first_frame", clip.first_frame},
               {"frames", clip.frames}};
  if (!clip.primary.empty()) json["primary"] = clip.primary;
  json["bytes"] = clip.bytes;
  return json;
}

Json to_json(const SkeletonInfo& skeleton) {
  return {{"id", skeleton.id},
          {"format", format_name(skeleton.format)},
          {"root", skeleton.root},
          {"joints", skeleton.joints},
          {"channels", skeleton.channels},
          {"takes", skeleton.takes},
          {"proportions", skeleton.proportions}};
}

Json to_json(const ArchiveStats& stats) {
  Json bytes = Json::object();
  for (const auto& [name, count] : stats.bytes) bytes[name] = count;
  Json fidelity = Json::object();
  for (const auto& [tier, takes] : stats.fidelity) fidelity[tier] = takes;
  return {{"takes", stats.takes},
          {"frames", stats.frames},
          {"seconds", stats.seconds},
          {"subjects", stats.subjects},
          {"skeletons", stats.skeletons},
          {"groups", stats.groups},
          {"clips",
           {{"primary", stats.primary_clips},
            {"repeated", stats.repeated_clips},
            {"unique", stats.unique_clips}}},
          {"raw_bytes", stats.raw_bytes},
          {"text_bytes", stats.text_bytes},
          {"archive_bytes", stats.archive_bytes},
          {"payload_bytes", stats.payload_bytes},
          {"bytes", bytes},
          {"ratio",
           {{"raw", ratio(stats.raw_bytes, stats.archive_bytes)},
            {"text", ratio(stats.text_bytes, stats.archive_bytes)}}},
          {"error_mm", to_json(stats.error_mm)},
          {"rotation_deg", to_json(stats.rotation_deg)},
          {"fidelity", fidelity}};
}

Json to_json(const Comparison& comparison, const Take& original) {
  Json skate = nullptr;
  if (comparison.foot_skate) {
    skate = {{"original", comparison.foot_skate->original},
             {"decoded", comparison.foot_skate->decoded}};
  }
  return {
      {"frames", comparison.frames},
      {"missing_frames", comparison.missing_frames},
      {"mean_mm", comparison.errors.mean},
      {"rms_mm", comparison.errors.rms},
      {"p99_mm", comparison.errors.p99},
      {"max_mm", comparison.errors.max},
      {"d_percent", comparison.d_percent},
      {"foot_skate_mm_s", skate},
      {"rotation_deg", to_json(comparison.turns)},
      {"local_rotation_deg", to_json(comparison.local_turns)},
      {"worst_place", worst_json(*original.skeleton, comparison.worst_place, original.frame_rate)},
      {"worst_turn", worst_json(*original.skeleton, comparison.worst_turn, original.frame_rate)}};
}

}  // namespace reprise::cli
