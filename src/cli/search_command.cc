#include "cli/search_command.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/interruption.h"
#include "cli/intervals.h"
#include "cli/motion_input.h"
#include "cli/options.h"
#include "cli/text.h"
#include "reprise/error.h"
#include "reprise/query/take_reading.h"

namespace reprise::cli {
namespace {

constexpr double longest_time = 1e9;
constexpr double furthest_mm = 1e9;
constexpr std::uint64_t most_results = 1'000'000'000;

/// A file, or stdin: a BVH, or an AMC where its ASF is given. It is read as the archive's takes of
/// the same skeleton are.
Take read_example(const std::filesystem::path& path, const ReadOptions& options,
                  const std::filesystem::path& archive) {
  std::optional<std::filesystem::path> asf;
  if (!options.asf.empty()) asf = options.asf.front();
  Take take = path == "-" ? read_motion_from_stdin(asf, options) : read_motion_file(path, options);
  read_as_stored(take, options, archive);
  return take;
}

/// What parts repeats of the example from the rest.
constexpr const char* rest_line = "--- like the example, but no repeats of it; by unlikeness ---\n";

std::string results_table(const std::vector<SearchResult>& results, bool bold) {
  using enum Table::Align;
  Table table({{"TAKE", left},
               {"SUBJECT", left},
               {"START", right},
               {"END", right},
               {"DISTANCE MM", right},
               {"UNLIKENESS", right}});  // repeats are ordered by distance, the rest by this
  for (const SearchResult& result : results) {
    table.add({result.take, result.subject, format_number(result.start, 2),
               format_number(result.end, 2), format_number(result.distance_mm, 1),
               format_number(result.unlikeness, 1)});
  }
  std::string text = table.text(bold);
  const auto repeats =
      static_cast<std::size_t>(std::ranges::count(results, true, &SearchResult::repeat));
  if (repeats == results.size()) return text;
  std::size_t at = 0;  // behind the headings and the repeats
  for (std::size_t line = 0; line <= repeats; ++line) at = text.find('\n', at) + 1;
  return text.insert(at, rest_line);
}

/// A sentence where nothing is near; else empty.
std::string nothing_near(const std::vector<SearchResult>& results) {
  if (results.empty() || std::ranges::any_of(results, &SearchResult::repeat)) return {};
  const double nearest =
      std::ranges::min_element(results, {}, &SearchResult::distance_mm)->distance_mm;
  return fmt::format(
      "nothing repeats the example; the nearest of what is most like it is {:.1f} mm away",
      nearest);
}

std::string nothing_found(const SearchOptions& options) {
  if (options.limit_mm) {
    return fmt::format("no take is within {:g} mm of the example", *options.limit_mm);
  }
  return "no take is like the example, or none has a body that could be compared with it; reprise "
         "info shows which joints were taken for a body's, --joint-map corrects it";
}

Json document_of(const std::vector<SearchResult>& results) {
  Json entries = Json::array();
  for (const SearchResult& result : results) {
    entries.push_back({{"take", result.take},
                       {"subject", result.subject},
                       {"start", result.start},
                       {"end", result.end},
                       {"distance_mm", result.distance_mm},
                       {"unlikeness", result.unlikeness},
                       {"repeat", result.repeat}});
  }
  return {{"results", entries}};
}

}  // namespace

void SearchCommand::setup(CLI::App& app) {
  add_archive(app, archive_);
  add_path(app, "--like", like_, "The example: a BVH or AMC file, or - for a BVH on stdin");
  add_text(app, "--id", id_, "The example: a take or a clip of the archive", "ID");
  add_number(app, "--from", options_.from, 0, longest_time,
             "Only a part of the example: from this second on");
  add_number(app, "--to", options_.to, 0, longest_time, "and up to this one");
  add_whole_number(app, "--top", options_.top, 1, most_results, "How many results (default 20)");
  add_number(app, "--limit-mm", options_.limit_mm, 0, furthest_mm,
             "Leave out what is further away than this");
  app.add_flag("--across-subjects", options_.across_subjects,
               "Leave out takes of the example's subject");
  app.add_flag("--all-occurrences", options_.all_occurrences,
               "Every stretch of a take that fits, not only the best");
  add_input_file(app, "--joint-map", joint_map_,
                 "Lines \"BODY JOINT = JOINT\" that correct which joints are which");
  app.add_flag("--cache", setup_.write_cache,
               "Keep what was decoded in ARCHIVE.features, for the next search");
  add_whole_number(app, "--jobs", setup_.jobs, 1, 1024, "Worker threads (default: all cores)");
  add_read_options(app, read_);
  add_examples(app, {"reprise search lib.rpz --id walk_01",
                     "reprise search lib.rpz --id walk_01 --from 2 --to 4 --all-occurrences",
                     "reprise search lib.rpz --like example.bvh --top 5 --json"});
}

void SearchCommand::check() {
  if (like_.empty() && id_.empty()) {
    throw Error(ErrorCode::usage, "search needs an example: --like FILE or --id ID");
  }
  if (!like_.empty() && !id_.empty()) {
    throw Error(ErrorCode::usage, "--like and --id exclude each other: there is one example");
  }
  if (like_ == "-" && joint_map_ == stdin_path) {
    throw Error(ErrorCode::usage, "only one of --like and --joint-map can be stdin");
  }
  if (options_.from && options_.to && *options_.from >= *options_.to) {
    throw Error(ErrorCode::usage, "--from must be before --to");
  }
  const bool reads = !read_.asf.empty() || read_.bvh_millimetres_per_unit || read_.up ||
                     read_.frame_rate || read_.partial;
  if (!id_.empty() && reads) {
    throw Error(ErrorCode::usage,
                "--asf, --unit-mm, --up, --fps and --partial are for an example from a FILE");
  }
  if (like_ == "-" && read_.asf.size() > 1) {
    throw Error(ErrorCode::usage, "stdin has no name to choose a skeleton by: give one --asf");
  }
  if (options_.across_subjects && id_.empty()) {
    throw Error(ErrorCode::usage, "--across-subjects needs --id: a file has no subject");
  }
}

ExitCode SearchCommand::run(Console& console) {
  if (!joint_map_.empty()) setup_.joint_map = read_joint_map(joint_map_);
  std::optional<Take> example;
  if (!like_.empty()) example = read_example(like_, read_, archive_);
  std::optional<Archive::Selection> selection;
  {
    const Archive archive(archive_);
    if (!id_.empty()) selection = archive.find(id_);
  }
  if (selection && (options_.from || options_.to)) {
    // Throws where the part is not in the take or clip.
    frames_of({options_.from, options_.to}, selection->frames, selection->take.frame_rate);
  }
  if (selection && selection->clip) {
    if (!options_.from) options_.from = selection->clip->start;
    if (!options_.to) options_.to = selection->clip->end;
  }
  std::optional<MotionSearch> search;
  {
    const InterruptionGuard guard;  // a cache that is being written is finished
    ProgressBar bar("search", console.progress_terminal());
    search.emplace(archive_, setup_, progress_sink(bar, console));
    InterruptionGuard::check();
  }
  if (!search->cache_problem().empty()) console.message(printable(search->cache_problem()));
  const std::vector<SearchResult> results =
      selection ? search->like(selection->take, options_) : search->like(*example, options_);
  if (results.empty()) console.message(nothing_found(options_));
  if (const std::string sentence = nothing_near(results); !sentence.empty())
    console.message(sentence);
  console.result(results_table(results, console.bold_results()));
  console.document(document_of(results));
  return exit_done;
}

}  // namespace reprise::cli
