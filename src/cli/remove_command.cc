#include "cli/remove_command.h"

#include <algorithm>

#include "cli/text.h"
#include "reprise/error.h"

namespace reprise::cli {
namespace {

std::string take_of(const Archive& archive, const std::string& id) {
  const Archive::Selection selection = archive.find(id);
  if (selection.clip) {
    throw Error(ErrorCode::not_found, "'" + id + "' is a clip; only whole takes are removed", {},
                "its take is " + selection.take.name);
  }
  return selection.take.name;
}

}  // namespace

void RemoveCommand::setup(CLI::App& app) {
  add_archive(app, archive_);
  add_many(app, "ID", ids_, "Takes, by name or an unambiguous end of it")->required();
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
