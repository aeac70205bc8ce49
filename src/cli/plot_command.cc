#include "cli/plot_command.h"

#include "cli/interruption.h"
#include "cli/json_output.h"
#include "cli/output_file.h"
#include "cli/plot_image.h"
#include "cli/summary_image.h"
#include "cli/text.h"
#include "reprise/error.h"

namespace reprise::cli {
namespace {

using enum Table::Align;

std::string clips_table(const SelfDistance& plot, bool bold) {
  Table table(
      {{"CLIP", left}, {"KIND", left}, {"START", right}, {"END", right}, {"PRIMARY", left}});
  for (const ClipInfo& clip : plot.clips) {
    table.add({clip.id, clip_kind_name(clip.kind), format_number(clip.start, 2),
               format_number(clip.end, 2), clip.primary});
  }
  return table.text(bold);
}

Json document_of(const std::string& take, const std::string& file, const SelfDistance& plot) {
  Json behaviours = Json::array(), clips = Json::array();
  for (const SelfDistance::Behaviour& behaviour : plot.behaviours) {
    behaviours.push_back(
        {{"start", behaviour.start}, {"end", behaviour.end}, {"group", behaviour.group}});
  }
  for (const ClipInfo& clip : plot.clips) {
    Json json = {{"id", clip.id},
                 {"kind", clip_kind_name(clip.kind)},
                 {"start", clip.start},
                 {"end", clip.end}};
    if (!clip.primary.empty()) json["primary"] = clip.primary;
    clips.push_back(json);
  }
  return {{"take", take},
          {"file", file},
          {"rate", plot.rate},
          {"paths", plot.paths.size()},
          {"behaviours", behaviours},
          {"clips", clips}};
}

std::string poses_table(const std::vector<KeyPose>& poses, bool bold) {
  Table table({{"POSE", right}, {"START", right}, {"END", right}, {"TIME", right}});
  for (std::size_t p = 0; p < poses.size(); ++p) {
    table.add({std::to_string(p + 1), format_number(poses[p].start, 2),
               format_number(poses[p].end, 2), format_number(poses[p].time, 2)});
  }
  return table.text(bold);
}

Json document_of(const std::string& take, const std::string& file,
                 const std::vector<KeyPose>& poses) {
  Json list = Json::array();
  for (const KeyPose& pose : poses) {
    list.push_back({{"start", pose.start}, {"end", pose.end}, {"time", pose.time}});
  }
  return {{"take", take}, {"file", file}, {"key_poses", list}};
}

}  // namespace

void PlotCommand::setup(CLI::App& app) {
  add_archive(app, archive_);
  add_text(app, "--summary", summary_, "The take or clip whose key poses are drawn in a row", "ID");
  add_text(app, "--self-distance", take_,
           "The take whose postures are compared with one another: its name or the end of it",
           "TAKE");
  add_path(app, "-o,--output", file_, "The PNG file to write; - is stdout")->required();
  add_input_file(
      app, "--joint-map", joint_map_,
      "With --summary: lines \"BODY JOINT = JOINT\" that correct which joints are which");
  app.add_flag("--overwrite", overwrite_, "Replace a file that exists");
  add_examples(app, {"reprise plot lib.rpz --summary walk_01 -o walk_01.png",
                     "reprise plot lib.rpz --self-distance walk_01 -o walk_01.png"});
}

void PlotCommand::check() {
  if (take_.empty() == summary_.empty()) {
    throw Error(ErrorCode::usage, "plot needs one of --summary ID and --self-distance TAKE");
  }
}

PlotCommand::Picture PlotCommand::self_distance_picture(const Archive& archive,
                                                        const Console& console) const {
  const TakeInfo take = archive.find_take(take_);
  const SelfDistance plot = self_distance(archive, take);
  return {png_of(plot), clips_table(plot, console.bold_results()),
          document_of(take.name, file_.string(), plot)};
}

PlotCommand::Picture PlotCommand::summary_picture(const Archive& archive,
                                                  const Console& console) const {
  const Archive::Selection selection = archive.find(summary_);
  const JointMap map = joint_map_.empty() ? JointMap{} : read_joint_map(joint_map_);
  const Take take = archive.extract(selection.take, selection.frames);
  if (take.frames() == 0) throw Error(ErrorCode::usage, "a take without frames has no poses");
  std::vector<KeyPose> poses = key_poses(take, map);
  std::string png = png_of(take, poses, map);
  const double begins = static_cast<double>(selection.frames.begin) / selection.take.frame_rate;
  for (KeyPose& pose : poses) {
    pose.start += begins;
    pose.end += begins;
    pose.time += begins;
  }
  return {std::move(png), poses_table(poses, console.bold_results()),
          document_of(selection.take.name, file_.string(), poses)};
}

ExitCode PlotCommand::run(Console& console) {
  const Archive archive(archive_);
  const bool to_stdout = file_ == "-";
  if (!to_stdout && !overwrite_ &&
      std::filesystem::exists(std::filesystem::symlink_status(file_))) {
    refuse_existing(file_);
  }
  if (!to_stdout) refuse_archive(file_, archive_);
  const Picture picture = summary_.empty() ? self_distance_picture(archive, console)
                                           : summary_picture(archive, console);
  if (to_stdout) {
    console.bytes(picture.png);
    return exit_done;
  }
  {
    const InterruptionGuard guard;  // leaves no half of a file
    write_file_atomically(file_, picture.png, overwrite_);
  }
  console.result(picture.text);
  console.document(picture.document);
  return exit_done;
}

}  // namespace reprise::cli
