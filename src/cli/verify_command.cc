#include "cli/verify_command.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/error_report.h"
#include "cli/interruption.h"
#include "cli/json_output.h"
#include "cli/text.h"
#include "cli/worst_errors.h"
#include "reprise/error.h"

namespace reprise::cli {
namespace {

Json document_of(const VerifyReport& report) {
  return {{"ok", report.ok},
          {"takes", report.takes},
          {"clips", report.clips},
          {"damaged", to_json(report.damaged)},
          {"error_mm", report.measured > 0 ? to_json(report.error_mm) : Json(nullptr)},
          {"rotation_deg", report.measured > 0 ? to_json(report.rotation_deg) : Json(nullptr)}};
}

std::string report_text(const VerifyReport& report, bool measured) {
  std::string text =
      fmt::format("{}, {}: {}\n", format_count(report.takes, "take"),
                  format_count(report.clips, "clip"), report.ok ? "all right" : "not all right");
  for (const Damage& damage : report.damaged) {
    text += printable(fmt::format("{}: {}", damage.id, damage.why)) + "\n";
  }
  if (report.measured > 0) {
    const char* how = measured ? "against the sources" : "as stored";
    text += fmt::format("error {}: {}\n", how, format_errors(report.error_mm));
    text += fmt::format("turns {}: {}\n", how, format_turns(report.rotation_deg));
  }
  return text;
}

/// An archive that cannot even be opened is reported in the same document as one with a damaged
/// clip; why it cannot is in `unopened` then.
VerifyReport report_of(const std::filesystem::path& archive,
                       const std::optional<std::filesystem::path>& against, const ReadOptions& read,
                       const ProgressSink& progress, std::optional<Error>& unopened) {
  try {
    return Archive(archive).verify(against, read, progress);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::damaged) throw;
    unopened = error;
    VerifyReport report;
    report.ok = false;
    report.damaged.push_back({"archive", error.reason()});
    return report;
  }
}

ErrorCode verdict(const VerifyReport& report) {
  const bool only_fidelity =
      !report.damaged.empty() &&
      std::all_of(report.damaged.begin(), report.damaged.end(),
                  [](const Damage& damage) { return damage.outside_fidelity; });
  return only_fidelity ? ErrorCode::failed : ErrorCode::damaged;
}

}  // namespace

void VerifyCommand::setup(CLI::App& app) {
  add_archive(app, archive_);
  add_path(app, "--against", against_,
           "Measure each take against its source in this folder, and hold it to its fidelity",
           "DIR");
  add_read_options(app, read_);
  add_examples(app, {"reprise verify lib.rpz", "reprise verify lib.rpz --against takes/"});
}

ExitCode VerifyCommand::run(Console& console) {
  std::optional<std::filesystem::path> against;
  if (!against_.empty()) against = against_;
  const InterruptionGuard guard;
  VerifyReport report;
  std::optional<Error> unopened;
  {
    ProgressBar bar("verify", console.progress_terminal());
    report = report_of(archive_, against, read_, progress_sink(bar, console), unopened);
  }
  WorstErrors worst;
  if (report.ok) {
    const Archive archive(archive_);
    worst = find_worst_errors(archive, archive.stats());
  }
  if (!unopened && (!report.ok || !console.quiet())) {
    console.result(report_text(report, against.has_value()) + worst_text(worst));
  }
  Json document = document_of(report);
  add_worst(worst, document);
  console.document(document);
  if (unopened) {
    console.complaint(report_line(*unopened));
    return exit_code(unopened->code());
  }
  if (report.ok) return exit_done;
  const ErrorCode code = verdict(report);
  console.complaint(printable(
      fmt::format("reprise: {}: {}", archive_.string(),
                  code == ErrorCode::damaged
                      ? "the archive is damaged"
                      : "some takes are outside their fidelity, or could not be measured")));
  return static_cast<int>(code);
}

}  // namespace reprise::cli
