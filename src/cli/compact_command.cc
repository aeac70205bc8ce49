#include "cli/compact_command.h"

#include <fmt/format.h>

#include "cli/text.h"

namespace reprise::cli {

void CompactCommand::setup(CLI::App& app) {
  add_archive(app, archive_);
  add_examples(app, {"reprise compact lib.rpz"});
}

ExitCode CompactCommand::run(Console& console) {
  const std::uint64_t before = Archive(archive_).stats().archive_bytes;
  {
    ProgressBar bar("compact", console.progress_terminal());
    compact(archive_, progress_sink(bar, console));
  }
  const std::uint64_t after = Archive(archive_).stats().archive_bytes;
  if (!console.quiet()) {
    console.result(fmt::format("{} before, {} now\n", format_size(before), format_size(after)));
  }
  console.document({{"bytes_before", before}, {"bytes_after", after}});
  return exit_done;
}

}  // namespace reprise::cli
