#include "cli/extract_command.h"

#include <fmt/format.h>

#include <memory>

#include "cli/interruption.h"
#include "cli/json_output.h"
#include "cli/motion_output.h"
#include "cli/options.h"
#include "cli/output_file.h"
#include "cli/text.h"
#include "cli/written_formats.h"
#include "reprise/error.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

Json entry_of(const PlannedExtract& entry, const std::vector<fs::path>& files) {
  Json json = {{"id", entry.id},
               {"take", entry.take.name},
               {"first_frame", entry.frames.begin},
               {"frames", entry.frames.end - entry.frames.begin},
               {"file", files.front().string()}};
  if (files.size() > 1) json["asf"] = files.back().string();
  return json;
}

bool is_whole(const PlannedExtract& entry) {
  return entry.frames.begin == 0 && entry.frames.end == entry.take.frames;
}

/// What is written of a take.
struct MotionText {
  std::string text;
  std::shared_ptr<const Skeleton> skeleton;
};

/// The source's own text where it is stored and asked for, whole: its numbers are not looked at.
MotionText motion_text(const Archive& archive, const PlannedExtract& entry,
                       std::optional<FidelityTier> fidelity) {
  const bool exact = entry.take.fidelity.tier == FidelityTier::exact &&
                     fidelity.value_or(FidelityTier::exact) == FidelityTier::exact;
  if (exact && is_whole(entry)) {
    return {archive.source_text(entry.take), archive.skeleton(entry.take)};
  }
  const Take take = is_whole(entry) ? archive.extract(entry.take, fidelity)
                                    : archive.extract(entry.take, entry.frames, fidelity);
  return {write_motion(take), take.skeleton};
}

}  // namespace

void ExtractCommand::setup(CLI::App& app) {
  add_archive(app, archive_);
  add_many(app, "ID", request_.ids, "Takes or clips");
  app.add_flag("--all", request_.all, "Every take");
  add_path(app, "-o,--output", file_, "The file to write for one ID; - is stdout");
  add_path(app, "-d,--directory", folder_, "The folder for many; the tree of names is kept", "DIR");
  app.add_option_function<std::string>(
         "--frames",
         [this](const std::string& text) {
           request_.frames = parse_frame_interval("--frames", text);
         },
         "Only frames A up to, not including, B of the take, from 0; either may be left out")
      ->type_name("A:B");
  app.add_option_function<std::string>(
         "--time",
         [this](const std::string& text) { request_.time = parse_time_interval("--time", text); },
         "The same in seconds")
      ->type_name("A:B");
  app.add_option_function<std::string>(
         "--fidelity", [this](const std::string& text) { request_.fidelity = parse_tier(text); },
         "A fidelity that is not higher than the stored one")
      ->type_name("TIER");
  app.add_option_function<std::string>(
         "--format",
         [this](const std::string& text) { request_.format = parse_motion_format(text); },
         "bvh or amc; it must be the format of the source")
      ->type_name("FORMAT");
  app.add_flag("--overwrite", overwrite_, "Replace files that exist");
  add_examples(app, {"reprise extract lib.rpz walk_01 -o walk_01.bvh",
                     "reprise extract lib.rpz walk_01 --time 2:4.5 -o -",
                     "reprise extract lib.rpz --all -d out/"});
}

void ExtractCommand::check() {
  const auto refuse = [](const std::string& why) { throw Error(ErrorCode::usage, why); };
  if (request_.all == !request_.ids.empty()) refuse("name takes or clips, or give --all");
  if (file_.empty() == folder_.empty()) {
    refuse("say where to write: -o FILE for one ID (- is stdout), or -d DIR for any number");
  }
  if (folder_ == "-") refuse("-d takes a folder; -o - writes to stdout");
  if (!file_.empty() && (request_.all || request_.ids.size() > 1)) {
    refuse("-o is for one ID; -d DIR takes any number");
  }
  // That a file is the archive itself is told later, in words of its own.
  const bool archive = file_.lexically_normal() == archive_.lexically_normal();
  if (!file_.empty() && file_ != "-" && !archive) check_written_ending(file_);
  if (request_.frames && request_.time) refuse("--frames and --time exclude each other");
}

void ExtractCommand::check_targets(ExtractPlan& plan) const {
  std::vector<PlannedExtract> kept;
  for (PlannedExtract& entry : plan.entries) {
    try {
      const fs::path target = path_inside(folder_, entry.file_name);
      std::error_code error;
      if (!overwrite_ && fs::exists(fs::symlink_status(target, error))) refuse_existing(target);
      kept.push_back(std::move(entry));
    } catch (const Error& error) {
      if (error.code() != ErrorCode::damaged) throw;
      plan.damaged.push_back({entry.take.name, error.reason()});
    }
  }
  plan.entries = std::move(kept);
}

ExitCode ExtractCommand::run(Console& console) {
  const InterruptionGuard guard;
  const Archive archive(archive_);
  ExtractPlan plan = plan_extract(archive, request_);
  if (file_ == "-") {
    console.bytes(motion_text(archive, plan.entries.front(), request_.fidelity).text);
    return exit_done;
  }
  if (folder_.empty()) {
    refuse_archive(file_, archive_);
    check_written_ending(file_, plan.entries.front().take);
    if (!overwrite_ && fs::exists(fs::symlink_status(file_))) refuse_existing(file_);
  } else {
    check_targets(plan);
  }

  const Json entries = write_all(archive, plan, console);
  console.document({{"extracted", entries},
                    {"damaged", to_json(plan.damaged)},
                    {"unwritten", to_json(plan.unwritten)}});
  for (const std::vector<Damage>& list : {plan.damaged, plan.unwritten}) {
    for (const Damage& entry : list) {
      console.complaint(
          printable(fmt::format("reprise: {}: {}: {}", archive_.string(), entry.id, entry.why)));
    }
  }
  if (!plan.damaged.empty()) return static_cast<int>(ErrorCode::damaged);
  return plan.unwritten.empty() ? exit_done : static_cast<int>(ErrorCode::failed);
}

Json ExtractCommand::write_all(const Archive& archive, ExtractPlan& plan, Console& console) const {
  Json entries = Json::array();
  MotionOutput output(archive_, overwrite_);
  ProgressBar bar("extract", console.progress_terminal());
  for (std::size_t i = 0; i < plan.entries.size(); ++i) {
    const PlannedExtract& entry = plan.entries[i];
    InterruptionGuard::check();
    bar.show({i, plan.entries.size(), entry.take.name});
    try {
      const MotionText motion = motion_text(archive, entry, request_.fidelity);
      const fs::path name = folder_.empty() ? file_ : fs::path(entry.file_name);
      const OutputFolder folder =
          folder_.empty() ? OutputFolder::of(file_) : OutputFolder::below(folder_, entry.file_name);
      const std::vector<fs::path> files =
          output.write(*motion.skeleton, motion.text, folder, name.filename().string());
      for (const fs::path& file : files) console.detail("wrote " + printable(file.string()));
      entries.push_back(entry_of(entry, files));
    } catch (const FileError& error) {
      if (folder_.empty()) throw;
      plan.unwritten.push_back({entry.take.name, error.what()});
    } catch (const Error& error) {
      // Another process has taken it out meanwhile.
      if (error.code() == ErrorCode::not_found && request_.all) continue;
      // What else the archive holds may be whole.
      if (error.code() != ErrorCode::damaged || folder_.empty()) throw;
      plan.damaged.push_back({entry.take.name, error.reason()});
    }
  }
  output.sync(folder_.empty() ? file_ : folder_);
  return entries;
}

}  // namespace reprise::cli
