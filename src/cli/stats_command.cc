#include "cli/stats_command.h"

#include <fmt/format.h>

#include "cli/json_output.h"
#include "cli/text.h"
#include "cli/worst_errors.h"

namespace reprise::cli {
namespace {

using enum Table::Align;

std::string share(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return "-";
  return fmt::format("{:.1f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string stats_text(const ArchiveStats& stats, bool bold) {
  Table counts({{"", left}, {"", right}});
  counts.add({"takes", std::to_string(stats.takes)});
  counts.add({"frames", std::to_string(stats.frames)});
  counts.add({"length", format_clock(stats.seconds)});
  counts.add({"subjects", std::to_string(stats.subjects)});
  counts.add({"skeletons", std::to_string(stats.skeletons)});
  counts.add({"behaviour groups", std::to_string(stats.groups)});
  counts.add({"primary clips", std::to_string(stats.primary_clips)});
  counts.add({"repeated clips", std::to_string(stats.repeated_clips)});
  counts.add({"unique clips", std::to_string(stats.unique_clips)});

  Table sizes({{"SIZE", left}, {"BYTES", right}, {"TO ARCHIVE", right}});
  sizes.add(
      {"raw", format_size(stats.raw_bytes), format_ratio(stats.raw_bytes, stats.archive_bytes)});
  sizes.add(
      {"text", format_size(stats.text_bytes), format_ratio(stats.text_bytes, stats.archive_bytes)});
  sizes.add({"payload", format_size(stats.payload_bytes), ""});
  sizes.add({"archive", format_size(stats.archive_bytes), ""});

  Table parts({{"SPENT ON", left}, {"BYTES", right}, {"SHARE", right}});
  for (const auto& [name, bytes] : stats.bytes) {
    if (bytes == 0) continue;
    parts.add({name, format_size(bytes), share(bytes, stats.archive_bytes)});
  }

  Table fidelity({{"FIDELITY", left}, {"TAKES", right}});
  for (const auto& [tier, takes] : stats.fidelity) fidelity.add({tier, std::to_string(takes)});

  return counts.text(bold) + "\n" + sizes.text(bold) + "\n" + parts.text(bold) + "\n" +
         fidelity.text(bold) + "\nerror: " + format_errors(stats.error_mm) +
         "\nturns: " + format_turns(stats.rotation_deg) + "\n";
}

}  // namespace

void StatsCommand::setup(CLI::App& app) {
  add_archive(app, archive_);
  add_examples(app, {"reprise stats lib.rpz", "reprise stats lib.rpz --json"});
}

ExitCode StatsCommand::run(Console& console) {
  const Archive archive(archive_);
  const ArchiveStats stats = archive.stats();
  const WorstErrors worst = find_worst_errors(archive, stats);
  console.result(stats_text(stats, console.bold_results()) + worst_text(worst));
  console.document(stats_document(stats, worst));
  return exit_done;
}

}  // namespace reprise::cli
