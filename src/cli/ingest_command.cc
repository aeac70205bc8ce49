#include "cli/ingest_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <thread>
#include <utility>

#include "cli/interruption.h"
#include "cli/json_output.h"
#include "cli/text.h"
#include "cli/worst_errors.h"
#include "reprise/error.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

constexpr double least_mean_mm = 0.001;
constexpr double greatest_mean_mm = 10000;
constexpr std::uint64_t greatest_jobs = 1024;

/// The prefix without the slashes at its end. Names in an archive are relative and have no "..".
std::string checked_prefix(std::string prefix) {
  prefix.erase(prefix.find_last_not_of('/') + 1);
  bool good = !prefix.empty() && prefix.front() != '/';
  for (const fs::path& component : fs::path(prefix)) {
    good = good && !component.empty() && component != "." && component != "..";
  }
  if (!good || prefix.find("//") != std::string::npos) {
    throw Error(ErrorCode::usage,
                "--prefix takes a relative path of names, such as cmu or 2024/day1");
  }
  return prefix;
}

/// The archive's figures; all 0 where no take has made it yet.
struct Figures {
  ArchiveStats stats;
  WorstErrors worst;
};
Figures figures_of(const fs::path& path) {
  if (!fs::exists(path)) return {};
  const Archive archive(path);
  Figures figures{archive.stats(), {}};
  figures.worst = find_worst_errors(archive, figures.stats);
  return figures;
}

/// Names below the first line of a dry run's summary, which counts them.
std::string with_names(const std::string& text, const std::vector<std::string>& names) {
  std::string lines;
  for (const std::string& name : names) lines += "  " + printable(name) + "\n";
  const std::size_t end = text.find('\n') + 1;
  return text.substr(0, end) + lines + text.substr(end);
}

/// "1000 mm, guessed for 3 takes by bodies of 1.70 to 1.82 m".
std::string unit_text(const AssumedUnit& unit) {
  const std::string takes = format_count(unit.takes, "take");
  if (unit.greatest_height_mm == 0) {
    return fmt::format("{:.6g} mm, assumed for {} without a body", unit.unit_mm, takes);
  }
  constexpr double metre = 1000;
  const std::string least = format_number(unit.least_height_mm / metre, 2);
  const std::string greatest = format_number(unit.greatest_height_mm / metre, 2);
  const std::string heights = least == greatest ? least : least + " to " + greatest;
  return fmt::format("{:.6g} mm, guessed for {} by bodies of {} m", unit.unit_mm, takes, heights);
}

std::string summary(const IngestReport& report, const ArchiveStats& stats, bool dry_run) {
  Table table({{"", Table::Align::left}, {"", Table::Align::left}});
  const std::size_t replaced = report.replaced.size();
  const std::string added = format_count(report.added.size() - (dry_run ? 0 : replaced), "take");
  table.add({dry_run ? "would add" : "added",
             dry_run ? added : fmt::format("{} in {:.1f} s", added, report.seconds)});
  if (replaced > 0) {
    table.add({dry_run ? "of them" : "replaced",
               format_count(replaced, "take") +
                   (dry_run ? " in place of what is there under the name" : "")});
  }
  table.add({"skipped", format_count(report.skipped.size(), "take") +
                            (report.skipped.size() == 1 ? " that was there already"
                                                        : " that were there already")});
  table.add({"rejected", format_count(report.rejected.size(), "input")});
  if (report.estimate) {
    table.add({"estimate", fmt::format("{} more in about {:.0f} s, from {}",
                                       format_size(report.estimate->bytes),
                                       std::max(1.0, report.estimate->seconds),
                                       format_count(report.estimate->sampled, "take"))});
  }
  for (const AssumedUnit& unit : report.assumed_units) table.add({"unit", unit_text(unit)});
  if (stats.takes > 0) {
    table.add(
        {"archive", fmt::format("{}, {} of motion in {}", format_count(stats.takes, "take"),
                                format_clock(stats.seconds), format_size(stats.archive_bytes))});
    table.add({"raw", fmt::format("{}, {}", format_size(stats.raw_bytes),
                                  format_ratio(stats.raw_bytes, stats.archive_bytes))});
    table.add({"text", fmt::format("{}, {}", format_size(stats.text_bytes),
                                   format_ratio(stats.text_bytes, stats.archive_bytes))});
    table.add({"error", format_errors(stats.error_mm)});
    table.add({"turns", format_turns(stats.rotation_deg)});
  }
  return dry_run ? with_names(table.text(), report.added) : table.text();
}

Json document_of(const IngestReport& report, const Figures& figures) {
  Json rejected = Json::array(), same = Json::array(), notes = Json::array(), estimate;
  for (const RejectedInput& input : report.rejected) {
    rejected.push_back(
        {{"path", input.path}, {"line", input.line}, {"why", input.why}, {"advice", input.advice}});
  }
  for (const SameSource& take : report.same_source) {
    same.push_back({{"name", take.name}, {"same_as", take.same_as}});
  }
  for (const InputNote& note : report.notes) {
    notes.push_back({{"path", note.path}, {"line", note.line}, {"what", note.what}});
  }
  if (report.estimate) {
    estimate = {{"bytes", report.estimate->bytes},
                {"seconds", report.estimate->seconds},
                {"sampled", report.estimate->sampled}};
  }
  Json assumed_units = Json::array();
  for (const AssumedUnit& unit : report.assumed_units) {
    Json entry = {{"unit_mm", unit.unit_mm}, {"takes", unit.takes}};
    if (unit.greatest_height_mm > 0) {
      entry["height_mm"] = {unit.least_height_mm, unit.greatest_height_mm};
    }
    assumed_units.push_back(entry);
  }
  return {{"added", report.added},
          {"replaced", report.replaced},
          {"same_source", same},
          {"skipped", report.skipped},
          {"other_fidelity", report.other_fidelity},
          {"other_metadata", report.other_metadata},
          {"other_reading", report.other_reading},
          {"assumed_units", assumed_units},
          {"implausible_units", report.implausible_units},
          {"takes_not_found", report.takes_not_found},
          {"rejected", rejected},
          {"notes", notes},
          {"other_kinds", Json(report.other_kinds)},
          {"estimate", estimate},
          {"seconds", report.seconds},
          {"stats", stats_document(figures.stats, figures.worst)}};
}

std::string place_line(const std::string& path, std::size_t line, const std::string& said) {
  const std::string place = line > 0 ? fmt::format("{}:{}", path, line) : path;
  return printable(fmt::format("{}: {}", place, said));
}

std::string rejection_line(const RejectedInput& input) {
  return place_line(input.path, input.line,
                    input.advice.empty() ? input.why : input.why + "; " + input.advice);
}

/// "7 files of other kinds: 4 .fbx, 3 .c3d", those with most files first.
std::string other_kinds_line(const std::map<std::string, std::size_t>& kinds) {
  constexpr std::size_t most_named = 8;
  std::vector<std::pair<std::string, std::size_t>> sorted(kinds.begin(), kinds.end());
  std::ranges::stable_sort(sorted, std::greater(), &std::pair<std::string, std::size_t>::second);
  std::size_t all = 0;
  std::string named;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const auto& [kind, files] = sorted[i];
    all += files;
    if (i >= most_named) continue;
    if (i > 0) named += ", ";
    named += std::to_string(files) + " ";
    // A name that is an ending and nothing else may be meant, where it is that of a format.
    const bool whole_name = is_motion_file(kind);
    named += kind.empty() ? "without an ending" : (whole_name ? "named just " : "") + kind;
  }
  return fmt::format("{} of other kinds: {}{}", format_count(all, "file"), named,
                     sorted.size() > most_named ? ", ..." : "");
}

/// What a user should know of the inputs that were taken in, or passed over.
void tell_of_inputs(const IngestReport& report, const Console& console) {
  constexpr std::size_t most_told = 10;
  for (const InputNote& note : report.notes) {
    console.message(place_line(note.path, note.line, note.what));
  }
  const std::size_t same = report.same_source.size();
  const std::size_t told = console.verbose() || same <= most_told ? same : most_told;
  for (std::size_t i = 0; i < told; ++i) {
    const SameSource& take = report.same_source[i];
    console.message(printable(take.name + ": the same as " + take.same_as));
  }
  if (told < same) {
    console.message(fmt::format("{} more that are the same as another one; -v or --json names them",
                                format_count(same - told, "take")));
  }
  if (!report.other_kinds.empty()) console.message(printable(other_kinds_line(report.other_kinds)));
}

}  // namespace

void IngestCommand::setup(CLI::App& app) {
  add_archive(app, archive_);
  add_many(app, "PATH", paths_, "BVH and AMC files, or folders that are searched through")
      ->required();
  app.add_option_function<std::string>(
         "--fidelity", [this](const std::string& text) { tier_ = parse_tier(text); },
         "How faithful takes are stored: preview (mean error at most 20 mm), standard (the "
         "default: every joint in every frame within 10 mm and 10 degrees), fine (within 1 mm and "
         "1 degree) or exact (byte for byte)")
      ->type_name("TIER");
  add_number(app, "--bound-mm", bound_mm_, FidelityLimits::least_bound_mm,
             FidelityLimits::greatest_bound_mm,
             "Another bound on every joint in every frame, in millimetres, instead of a TIER");
  add_number(app, "--bound-deg", bound_deg_, FidelityLimits::least_bound_deg,
             FidelityLimits::greatest_bound_deg,
             "With --bound-mm: the bound on every joint's orientation, in degrees (default: the "
             "number of --bound-mm)");
  add_number(
      app, "--mean-mm", mean_mm_, least_mean_mm, greatest_mean_mm,
      "Greatest mean joint error of a take, in millimetres (default 20); means --fidelity preview");
  options_.jobs = std::max(1U, std::thread::hardware_concurrency());
  add_whole_number(app, "--jobs", options_.jobs, 1, greatest_jobs,
                   "Threads (default: all); the result is the same for any number");
  add_read_options(app, options_.read);
  add_input_file(app, "--metadata", metadata_,
                 "CSV with the columns take, subject, description, tags, unit_mm, fps; - is stdin");
  app.add_option_function<std::string>(
         "--prefix", [this](const std::string& text) { options_.prefix = checked_prefix(text); },
         "Put P/ in front of the names of this ingest")
      ->type_name("P");
  app.add_flag("--replace", options_.replace,
               "Replace takes that are there with other content, metadata or another fidelity");
  app.add_flag_callback(
      "--no-contacts", [this] { options_.contacts = false; },
      "Do not hold feet where they stand: for comparison; they slide more");
  app.add_flag_callback(
      "--no-repeats", [this] { options_.repeats = false; },
      "Look for no repeated motion: each take is one unique clip");
  app.add_flag("--dry-run", options_.dry_run, "Say what would be done, and write nothing");
  add_examples(app, {"reprise ingest lib.rpz takes/",
                     "reprise ingest lib.rpz cmu/ --fps 120 --fidelity exact"});
}

void IngestCommand::check() {
  for (const std::string& path : paths_) {
    if (path.empty()) throw Error(ErrorCode::usage, "PATH is empty");
    if (path == "-") {
      throw Error(ErrorCode::usage,
                  "PATH takes files and folders: a take is named by its file, which stdin has not");
    }
    options_.paths.emplace_back(path);
  }
  options_.fidelity = fidelity();
  if (!metadata_.empty()) options_.metadata = metadata_;
}

Fidelity IngestCommand::fidelity() const {
  if (bound_mm_ && tier_) {
    throw Error(ErrorCode::usage, "--bound-mm is a fidelity of its own; it excludes --fidelity");
  }
  if (mean_mm_ && (bound_mm_ || tier_.value_or(FidelityTier::preview) != FidelityTier::preview)) {
    throw Error(ErrorCode::usage, "--mean-mm is for the fidelity preview");
  }
  if (bound_deg_ && !bound_mm_) {
    throw Error(ErrorCode::usage, "--bound-deg goes with --bound-mm");
  }
  if (mean_mm_) return {FidelityTier::preview, *mean_mm_, 0};
  if (bound_mm_) return {FidelityTier::bound, *bound_mm_, bound_deg_.value_or(*bound_mm_)};
  return fidelity_of(tier_.value_or(FidelityTier::standard));
}

ExitCode IngestCommand::run(Console& console) {
  const InterruptionGuard guard;
  IngestReport report;
  {
    ProgressBar bar("ingest", console.progress_terminal());
    report = ingest(archive_, options_, progress_sink(bar, console));
  }
  for (const std::string& name : report.added) console.detail("added " + printable(name));
  for (const std::string& name : report.skipped) console.detail("skipped " + printable(name));
  for (const RejectedInput& input : report.rejected) console.complaint(rejection_line(input));
  tell_of_inputs(report, console);
  if (options_.replace && report.replaced.empty()) {
    console.message(
        "--replace replaced nothing: no take of these names is there with other content, metadata "
        "or fidelity");
  }
  if (!report.other_fidelity.empty()) {
    console.message(
        fmt::format("{} stored with another fidelity than asked for, and kept so; "
                    "--replace stores anew",
                    format_count(report.other_fidelity.size(), "take")));
  }
  if (!report.other_metadata.empty()) {
    console.message(
        fmt::format("{} stored with other metadata than given, and kept so; --replace stores anew",
                    format_count(report.other_metadata.size(), "take")));
  }
  if (!report.other_reading.empty()) {
    console.message(
        fmt::format("{} stored with another unit, up axis or frame rate than asked for, and kept "
                    "so; --replace stores "
                    "anew",
                    format_count(report.other_reading.size(), "take")));
  }
  for (const AssumedUnit& unit : report.assumed_units) {
    if (unit.greatest_height_mm > 0) continue;
    console.message(
        fmt::format("nothing says the unit of {}, and there is no body of 0.9 to 2.3 m to guess it "
                    "from: {:.6g} "
                    "mm are assumed; --unit-mm says another",
                    format_count(unit.takes, "take"), unit.unit_mm));
  }
  if (!report.implausible_units.empty()) {
    console.message(printable(fmt::format(
        "{} of bodies that their ASF's units make smaller than 0.9 m or taller than 2.3 m, such as "
        "'{}'",
        format_count(report.implausible_units.size(), "take"), report.implausible_units.front())));
  }
  if (!report.takes_not_found.empty()) {
    console.message(printable(fmt::format("{}: {} of no take that was given, such as '{}'",
                                          metadata_ == stdin_path ? "stdin" : metadata_.string(),
                                          format_count(report.takes_not_found.size(), "row"),
                                          report.takes_not_found.front())));
  }
  if (report.added.size() + report.skipped.size() + report.rejected.size() == 0) {
    console.message("no BVH or AMC file was found; links to folders are not followed");
  }
  if (!options_.dry_run && report.rejected.empty() && !fs::exists(archive_)) {
    throw Error(ErrorCode::failed, "no archive was made, as there is nothing to store",
                {archive_.string()});
  }
  const Figures figures = figures_of(archive_);
  if (!console.quiet()) console.result(summary(report, figures.stats, options_.dry_run));
  console.document(document_of(report, figures));
  return report.rejected.empty() ? exit_done : static_cast<int>(ErrorCode::rejected_input);
}

}  // namespace reprise::cli
