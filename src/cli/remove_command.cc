#include "cli/remove_command.h"

#include <algorithm>

#include "cli/text.h"
#include "reprise/error.h"

namespace reprise::cli {
namespace {

/// Whether an ID is the end of a name from the middle of a component on. What is meant by that
/// changes with what else is stored: the same command twice must not remove two takes.
bool is_end_of_component(const std::string& name, const std::string& id) {
  for (const char* extension : {"", ".amc", ".bvh"}) {
    const std::string end = id + extension;
    if (name.size() <= end.size() || !name.ends_with(end)) continue;
    return name[name.size() - end.size() - 1] != '/';
  }
  return false;
}

std::string take_of(const Archive& archive, const std::string& id) {
  const Archive::Selection selection = archive.find(id);
  if (selection.clip) {
    throw Error(ErrorCode::not_found, "'" + id + "' is a clip; only whole takes are removed", {},
                "its take is " + selection.take.name);
  }
  const std::string& name = selection.take.name;
  if (is_end_of_component(name, id)) {
    throw Error(ErrorCode::not_found, "there is no take '" + id + "'", {},
                "only '" + name + "' ends so; to remove it, give its name from a slash on");
  }
  return name;
}

}  // namespace

void RemoveCommand::setup(CLI::App& app) {
  add_archive(app, archive_);
  add_many(app, "ID", ids_, "Takes, by name or an unambiguous end of it from a slash on")
      ->required();
  add_examples(app, {"reprise remove lib.rpz walk_01 walk_02", "reprise compact lib.rpz"});
}

ExitCode RemoveCommand::run(Console& console) {
  // Names are looked up before anything changes, so that what is removed can be told in full.
  std::vector<std::string> names;
  {
    const Archive archive(archive_);
    for (const std::string& id : ids_) {
      const std::string name = take_of(archive, id);
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  {
    ProgressBar bar("remove", console.progress_terminal());
    remove_takes(archive_, names, progress_sink(bar, console));
  }
  for (const std::string& name : names) console.detail("removed " + printable(name));
  if (!console.quiet()) console.result("removed " + format_count(names.size(), "take") + "\n");
  console.document({{"removed", names}});
  return exit_done;
}

}  // namespace reprise::cli
