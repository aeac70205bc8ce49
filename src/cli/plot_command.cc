#include "cli/plot_command.h"

#include "cli/json_output.h"
#include "cli/output_file.h"
#include "cli/plot_image.h"
#include "cli/text.h"

namespace reprise::cli {
namespace {

using enum Table::Align;

std::string clips_table(const SelfDistance& plot, bool bold) {
  Table table(
      {{"CLIP", right}, {"KIND", left}, {"START", right}, {"END", right}, {"PRIMARY", right}});
  for (std::size_t c = 0; c < plot.clips.size(); ++c) {
    const SelfDistance::Clip& clip = plot.clips[c];
    table.add({std::to_string(c + 1), clip_kind_name(clip.kind), format_number(clip.start, 2),
               format_number(clip.end, 2),
               clip.primary ? std::to_string(*clip.primary + 1) : std::string()});
  }
  return table.text(bold);
}

Json document_of(const std::string& take, const std::string& file, const SelfDistance& plot) {
  Json behaviours = Json::array(), clips = Json::array();
  for (const SelfDistance::Behaviour& behaviour : plot.behaviours) {
    behaviours.push_back(
        {{"start", behaviour.start}, {"end", behaviour.end}, {"group", behaviour.group}});
  }
  for (const SelfDistance::Clip& clip : plot.clips) {
    Json json = {{"kind", clip_kind_name(clip.kind)}, {"start", clip.start}, {"end", clip.end}};
    if (clip.primary) {
      json["primary"] = {{"start", plot.clips[*clip.primary].start},
                         {"end", plot.clips[*clip.primary].end}};
    }
    clips.push_back(json);
  }
  return {{"take", take},
          {"file", file},
          {"rate", plot.rate},
          {"paths", plot.paths.size()},
          {"behaviours", behaviours},
          {"clips", clips}};
}

}  // namespace

void PlotCommand::setup(CLI::App& app) {
  add_archive(app, archive_);
  app.add_option("--self-distance", take_,
                 "The take whose postures are compared with one another: its name or the end of it")
      ->type_name("TAKE")
      ->required();
  add_path(app, "-o,--output", file_, "The PNG file to write; - is stdout")->required();
  app.add_flag("--overwrite", overwrite_, "Replace a file that exists");
  add_examples(app, {"reprise plot lib.rpz --self-distance walk_01 -o walk_01.png"});
}

ExitCode PlotCommand::run(Console& console) {
  const Archive archive(archive_);
  const TakeInfo take = archive.find_take(take_);
  const bool to_stdout = file_ == "-";
  if (!to_stdout && !overwrite_ &&
      std::filesystem::exists(std::filesystem::symlink_status(file_))) {
    refuse_existing(file_);
  }
  const SelfDistance plot = self_distance(archive, take);
  const std::string image = png_of(plot);
  if (to_stdout) {
    console.bytes(image);
    return exit_done;
  }
  write_file_atomically(file_, image, overwrite_);
  console.result(clips_table(plot, console.bold_results()));
  console.document(document_of(take.name, file_.string(), plot));
  return exit_done;
}

}  // namespace reprise::cli
