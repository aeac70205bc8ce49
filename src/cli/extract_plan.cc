#include "cli/extract_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "cli/json_output.h"
#include "reprise/error.h"

namespace reprise::cli {
namespace {

/// A clip's own file beside its take's. The part up to the first '_' stays, by which an ASF is
/// found.
std::string clip_file_name(const TakeInfo& take, const ClipInfo& clip) {
  std::string name = take.name;
  const std::string extension = "." + format_name(take.format);
  if (name.ends_with(extension)) name.resize(name.size() - extension.size());
  return name + "_" + clip.id + extension;
}

/// Whether what is stored keeps the promise of a tier.
bool holds(const Fidelity& stored, FidelityTier asked) {
  if (stored.tier == FidelityTier::exact || asked == FidelityTier::preview) return true;
  if (stored.tier == FidelityTier::preview || asked == FidelityTier::exact) return false;
  const Fidelity wanted = fidelity_of(asked);
  return stored.limit_mm <= wanted.limit_mm && stored.limit_deg <= wanted.limit_deg;
}

void check_wishes(const TakeInfo& take, const ExtractRequest& request) {
  if (request.fidelity && !holds(take.fidelity, *request.fidelity)) {
    throw Error(ErrorCode::usage,
                fmt::format("{} is stored as {}; it cannot be extracted as {}", take.name,
                            tier_name(take.fidelity.tier), tier_name(*request.fidelity)));
  }
  if (request.format && *request.format != take.format) {
    throw Error(ErrorCode::usage,
                fmt::format("{} comes from {}; it cannot be written as {} yet", take.name,
                            format_name(take.format), format_name(*request.format)));
  }
}

PlannedExtract plan_one(const std::string& id, const Archive::Selection& selection,
                        const ExtractRequest& request) {
  const TakeInfo& take = selection.take;
  check_wishes(take, request);
  FrameRange frames = selection.frames;
  if (request.frames) frames = frames_of(*request.frames, frames);
  if (request.time) frames = frames_of(*request.time, frames, take.frame_rate);
  const std::string file_name = selection.clip ? clip_file_name(take, *selection.clip)
                                               : motion_file_name(take.name, take.format);
  return {id, take, frames, file_name};
}

std::vector<PlannedExtract> plan_all(const Archive& archive, const ExtractRequest& request,
                                     std::vector<Damage>& damaged) {
  std::vector<PlannedExtract> plan;
  if (request.all) {
    for (const TakeInfo& take : archive.readable_takes(damaged)) {
      plan.push_back(plan_one(take.name, {take, {0, take.frames}, std::nullopt}, request));
    }
    return plan;
  }
  for (const std::string& id : request.ids) plan.push_back(plan_one(id, archive.find(id), request));
  return plan;
}

}  // namespace

std::string motion_file_name(std::string_view name, MotionFormat format) {
  const std::string extension = "." + format_name(format);
  return name.ends_with(extension) ? std::string(name) : std::string(name) + extension;
}

ExtractPlan plan_extract(const Archive& archive, const ExtractRequest& request) {
  ExtractPlan plan;
  std::map<std::string, std::vector<PlannedExtract>> by_file;
  std::vector<std::string> files;  // in the order in which they were asked for
  for (PlannedExtract& entry : plan_all(archive, request, plan.damaged)) {
    std::vector<PlannedExtract>& sharing = by_file[entry.file_name];
    if (sharing.empty()) files.push_back(entry.file_name);
    const auto same = [&](const PlannedExtract& other) {
      return other.take.id == entry.take.id && other.frames.begin == entry.frames.begin &&
             other.frames.end == entry.frames.end;
    };
    if (std::ranges::none_of(sharing, same)) sharing.push_back(std::move(entry));
  }
  for (const std::string& file : files) {
    std::vector<PlannedExtract>& sharing = by_file.at(file);
    if (sharing.size() == 1) {
      plan.entries.push_back(std::move(sharing.front()));
      continue;
    }
    if (!request.all) {
      throw Error(ErrorCode::failed, fmt::format("{} and {} would both be written to {}",
                                                 sharing[0].id, sharing[1].id, file));
    }
    for (const PlannedExtract& entry : sharing) {
      const PlannedExtract& other = sharing[&entry == &sharing[0] ? 1 : 0];
      plan.unwritten.push_back(
          {entry.take.name, fmt::format("'{}' would be written to {}, too; -o writes each of them "
                                        "to a file of its own",
                                        other.take.name, file)});
    }
  }
  return plan;
}

}  // namespace reprise::cli
