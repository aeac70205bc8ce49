#include "cli/info_command.h"

#include <fmt/format.h>

#include "cli/json_output.h"
#include "cli/text.h"
#include "cli/worst_errors.h"
#include "reprise/query/body_joints.h"
#include "reprise/query/key_poses.h"

namespace reprise::cli {
namespace {

using enum Table::Align;

Table facts() { return Table({{"", left}, {"", left}}); }

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string archive_text(const ArchiveInfo& info, const std::vector<std::string>& subjects) {
  const ArchiveStats& stats = info.stats;
  Table table = facts();
  table.add({"content digest", info.content_digest});
  table.add({"format version", std::to_string(info.format_version)});
  table.add({"written by", info.written_by});
  table.add({"takes", fmt::format("{}, {} frames, {} of motion", stats.takes, stats.frames,
                                  format_clock(stats.seconds))});
  table.add({"clips", fmt::format("{} primary, {} repeated, {} unique", stats.primary_clips,
                                  stats.repeated_clips, stats.unique_clips)});
  table.add({"subjects", fmt::format("{}: {}", subjects.size(), joined(subjects))});
  table.add({"skeletons", std::to_string(stats.skeletons)});
  table.add({"archive", format_size(stats.archive_bytes)});
  table.add({"raw", fmt::format("{}, {}", format_size(stats.raw_bytes),
                                format_ratio(stats.raw_bytes, stats.archive_bytes))});
  table.add({"text", fmt::format("{}, {}", format_size(stats.text_bytes),
                                 format_ratio(stats.text_bytes, stats.archive_bytes))});
  table.add({"error", format_errors(stats.error_mm)});
  table.add({"turns", format_turns(stats.rotation_deg)});
  return table.text();
}

Json archive_document(const Archive& archive, const ArchiveInfo& info,
                      const std::vector<std::string>& subjects) {
  return {{"content_digest", info.content_digest},
          {"format_version", info.format_version},
          {"written_by", info.written_by},
          {"subjects", subjects},
          {"stats", stats_document(info.stats, find_worst_errors(archive, info.stats))}};
}

std::string limit_text(const Fidelity& fidelity) {
  if (fidelity.tier == FidelityTier::exact) return "exact, the source byte for byte";
  if (fidelity.tier == FidelityTier::preview) {
    return fmt::format("preview, mean error at most {} mm", fidelity.limit_mm);
  }
  return fmt::format("{}, every joint within {} mm and {} degrees", tier_name(fidelity.tier),
                     fidelity.limit_mm, fidelity.limit_deg);
}

std::string worst_text(const TakeInfo& take, const Skeleton& skeleton, const JointAt& at) {
  return fmt::format("{}, frame {}, {:.3f} s", joint_label(skeleton, at.joint), at.frame,
                     static_cast<double>(at.frame) / take.frame_rate);
}

std::string take_text(const TakeInfo& take, const Skeleton& skeleton,
                      const std::vector<ClipInfo>& clips) {
  Table table = facts();
  table.add({"take", take.name});
  if (!take.subject.empty()) table.add({"subject", take.subject});
  if (!take.description.empty()) table.add({"description", take.description});
  if (!take.tags.empty()) table.add({"tags", take.tags});
  table.add({"format", format_name(take.format)});
  table.add(
      {"unit", fmt::format("{:.6g} mm{}", take.unit_mm, take.unit_assumed ? " (assumed)" : "")});
  table.add(
      {"up", fmt::format("{}{}", up_axis_name(take.up), take.up_assumed ? " (assumed)" : "")});
  table.add({"length", fmt::format("{} at {:.6g} Hz{}, {:.3f} s",
                                   format_count(static_cast<std::uint64_t>(take.frames), "frame"),
                                   take.frame_rate, take.frame_rate_assumed ? " (assumed)" : "",
                                   take.seconds())});
  table.add({"skeleton", std::to_string(take.skeleton)});
  table.add({"fidelity", limit_text(take.fidelity)});
  table.add({"error", format_errors(take.error_mm)});
  table.add({"turns", format_turns(take.rotation_deg)});
  if (take.fidelity.tier != FidelityTier::exact) {
    table.add({"worst place", worst_text(take, skeleton, take.worst_place)});
    table.add({"worst turn", worst_text(take, skeleton, take.worst_turn)});
  }
  table.add({"raw", format_size(take.raw_bytes)});
  table.add({"text", format_size(take.text_bytes)});
  table.add({"payload", fmt::format("{}, {} of raw", format_size(take.payload_bytes),
                                    format_ratio(take.raw_bytes, take.payload_bytes))});
  table.add({"source digest", take.source_digest});
  for (const ClipInfo& clip : clips) {
    table.add({"clip", fmt::format("{}  {}  {:.2f} s to {:.2f} s", clip.id,
                                   clip_kind_name(clip.kind), clip.start, clip.end)});
  }
  return table.text();
}

Json clips_array(const std::vector<ClipInfo>& clips) {
  Json entries = Json::array();
  for (const ClipInfo& clip : clips) entries.push_back(to_json(clip));
  return entries;
}

/// A joint of a body: its name, that of the skeleton's joint, "" where there is none, and how it
/// was found.
struct FoundJoint {
  std::string body_joint, joint, found_by;
};

std::vector<FoundJoint> body_of(const Skeleton& skeleton, const JointMap& map) {
  const BodyMatch match = match_body(skeleton, map);
  std::vector<FoundJoint> body;
  for (std::size_t i = 0; i < body_joint_count; ++i) {
    const int joint = match.joints[i];
    body.push_back({std::string(body_joint_name(static_cast<BodyJoint>(i))),
                    joint < 0 ? "" : skeleton.joints[static_cast<std::size_t>(joint)].name,
                    std::string(body_source_name(match.sources[i]))});
  }
  return body;
}

std::string body_text(const Skeleton& skeleton, const JointMap& map) {
  Table table({{"", left}, {"", left}, {"", left}});
  for (const FoundJoint& found : body_of(skeleton, map)) {
    table.add({found.body_joint, found.joint.empty() ? "-" : found.joint,
               found.joint.empty() ? "" : "by " + found.found_by});
  }
  return (match_body(skeleton, map).is_body() ? "\nbody\n" : "\nno whole body\n") + table.text();
}

std::string key_poses_text(const Take& take, const JointMap& map) {
  std::string text;
  for (const KeyPose& pose : key_poses(take, map)) {
    text += fmt::format("{}{:.2f}", text.empty() ? "" : ", ", pose.time);
  }
  Table table = facts();
  table.add({"key poses", text + " s"});
  return table.text();
}

Json key_poses_array(const Take& take, const JointMap& map) {
  Json poses = Json::array();
  for (const KeyPose& pose : key_poses(take, map)) {
    poses.push_back({{"start", pose.start}, {"end", pose.end}, {"time", pose.time}});
  }
  return poses;
}

Json body_document(const Skeleton& skeleton, const JointMap& map) {
  Json fields = Json::object();
  for (const FoundJoint& found : body_of(skeleton, map)) fields[found.body_joint] = found.joint;
  return fields;
}

Json body_sources(const Skeleton& skeleton, const JointMap& map) {
  Json fields = Json::object();
  for (const FoundJoint& found : body_of(skeleton, map)) fields[found.body_joint] = found.found_by;
  return fields;
}

Json take_document(const TakeInfo& take, const Skeleton& skeleton,
                   const std::vector<ClipInfo>& clips) {
  Json fields = to_json(take, skeleton);
  fields["description"] = take.description;
  fields["tags"] = take.tags;
  fields["skeleton"] = take.skeleton;
  fields["frame_rate_assumed"] = take.frame_rate_assumed;
  fields["text_bytes"] = take.text_bytes;
  fields["source_digest"] = take.source_digest;
  fields["clips"] = clips_array(clips);
  return {{"take", fields}};
}

std::string clips_text(const std::vector<ClipInfo>& clips) {
  Table table = facts();
  for (const ClipInfo& clip : clips) {
    table.add({"clip", clip.id});
    table.add({"take", clip.take});
    table.add({"kind", clip_kind_name(clip.kind)});
    if (!clip.primary.empty()) table.add({"primary", clip.primary});
    if (clip.group != 0) table.add({"group", std::to_string(clip.group)});
    table.add({"frames", fmt::format("{}:{}", clip.first_frame, clip.first_frame + clip.frames)});
    table.add({"time", fmt::format("{:.3f} s to {:.3f} s", clip.start, clip.end)});
    table.add({"size", format_size(clip.bytes)});
  }
  return table.text();
}

/// The clips of exactly this take: a filter takes the end of a name, too.
std::vector<ClipInfo> clips_of(const Archive& archive, const TakeInfo& take) {
  TakeFilter filter;
  filter.take = take.name;
  std::vector<ClipInfo> clips = archive.clips(filter);
  std::erase_if(clips, [&](const ClipInfo& clip) { return clip.take != take.name; });
  return clips;
}

}  // namespace

void InfoCommand::setup(CLI::App& app) {
  add_archive(app, archive_);
  add_text(app, "ID", id_, "A take or a clip; without it, the archive", "");
  add_input_file(app, "--joint-map", joint_map_,
                 "Lines \"BODY JOINT = JOINT\" that correct which joints are which");
  add_examples(app, {"reprise info lib.rpz", "reprise info lib.rpz walk_01"});
}

ExitCode InfoCommand::run(Console& console) {
  const Archive archive(archive_);
  if (id_.empty()) {
    const ArchiveInfo info = archive.info();
    const auto subjects = archive.subjects();
    console.result(archive_text(info, subjects));
    console.document(archive_document(archive, info, subjects));
    return exit_done;
  }
  const Archive::Selection selection = archive.find(id_);
  if (selection.clip) {
    const auto clips = archive.find_clips(id_);
    console.result(clips_text(clips));
    console.document({{"clips", clips_array(clips)}});
  } else {
    const auto clips = clips_of(archive, selection.take);
    const JointMap map = joint_map_.empty() ? JointMap{} : read_joint_map(joint_map_);
    const Take take = archive.extract(selection.take);
    console.result(take_text(selection.take, *take.skeleton, clips) + key_poses_text(take, map) +
                   body_text(*take.skeleton, map));
    Json document = take_document(selection.take, *take.skeleton, clips);
    document["take"]["key_poses"] = key_poses_array(take, map);
    document["take"]["body"] = body_document(*take.skeleton, map);
    document["take"]["body_found_by"] = body_sources(*take.skeleton, map);
    console.document(document);
  }
  return exit_done;
}

}  // namespace reprise::cli
