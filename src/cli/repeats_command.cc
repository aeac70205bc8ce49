#include "cli/repeats_command.h"

#include <fmt/format.h>

#include "cli/intervals.h"
#include "cli/json_output.h"
#include "cli/text.h"
#include "reprise/error.h"

namespace reprise::cli {
namespace {

using enum Table::Align;

/// Longer takes than this are beyond what an archive holds.
constexpr double most_seconds = 1e7;

std::string groups_table(const std::vector<RecurringMotion>& groups, bool bold) {
  Table table({{"GROUP", left},
               {"TAKE", left},
               {"SUBJECT", left},
               {"START", right},
               {"END", right},
               {"DISTANCE MM", right},
               {"CLIP", left}});
  for (const RecurringMotion& group : groups) {
    for (const MotionOccurrence& occurrence : group.occurrences) {
      table.add({group.id, occurrence.take, occurrence.subject, format_number(occurrence.start, 2),
                 format_number(occurrence.end, 2), format_number(occurrence.distance_mm, 1),
                 occurrence.clip});
    }
  }
  return table.text(bold);
}

Json document_of(const std::vector<RecurringMotion>& groups) {
  Json list = Json::array();
  for (const RecurringMotion& group : groups) {
    Json occurrences = Json::array();
    for (const MotionOccurrence& occurrence : group.occurrences) {
      occurrences.push_back({{"clip", occurrence.clip},
                             {"take", occurrence.take},
                             {"subject", occurrence.subject},
                             {"start", occurrence.start},
                             {"end", occurrence.end},
                             {"distance_mm", occurrence.distance_mm}});
    }
    list.push_back({{"id", group.id}, {"occurrences", occurrences}});
  }
  return {{"groups", list}};
}

}  // namespace

void RepeatsCommand::setup(CLI::App& app) {
  add_archive(app, archive_);
  add_text(app, "ID", id_, "Only the motions of this take, or the repeats of this clip", "");
  add_number(app, "--from", from_, 0, most_seconds,
             "Only the repeats of the part of ID that begins here, in seconds");
  add_number(app, "--to", to_, 0, most_seconds, "and ends here");
  app.add_flag("--across-subjects", across_subjects_,
               "Only motions that two subjects or more have; wider limits between subjects");
  add_number(app, "--min-seconds", least_seconds_, 0, most_seconds,
             "Only occurrences at least this long");
  add_whole_number(app, "--jobs", jobs_, 1, 1024, "Worker threads (default: all cores)");
  add_examples(app, {"reprise repeats lib.rpz", "reprise repeats lib.rpz walk_01 --min-seconds 1",
                     "reprise repeats lib.rpz walk_01 --from 2.5 --to 4 --json"});
}

void RepeatsCommand::check() {
  if (id_.empty() && (from_ || to_)) {
    throw Error(ErrorCode::usage, "--from and --to are a part of ID, which is missing");
  }
  if (from_ && to_ && *from_ >= *to_) {
    throw Error(ErrorCode::usage, "--from must be before --to");
  }
}

RepeatQuery RepeatsCommand::query_of(const Archive& archive) const {
  RepeatQuery query;
  query.across_subjects = across_subjects_;
  query.least_seconds = least_seconds_;
  query.jobs = jobs_;
  if (id_.empty()) return query;
  const Archive::Selection selection = archive.find(id_);
  query.take = selection.take;
  const Interval<double> part{from_, to_};
  const bool whole_take = selection.frames.end - selection.frames.begin == selection.take.frames;
  if (from_ || to_ || !whole_take) {
    query.frames = frames_of(part, selection.frames, selection.take.frame_rate);
  }
  return query;
}

ExitCode RepeatsCommand::run(Console& console) {
  const Archive archive(archive_);
  const RepeatQuery query = query_of(archive);
  std::vector<RecurringMotion> groups;
  {
    ProgressBar bar("repeats", console.progress_terminal());
    groups = archive.repeats(query, progress_sink(bar, console));
  }
  if (groups.empty()) {
    console.message("no motion recurs");
  } else {
    console.result(groups_table(groups, console.bold_results()));
  }
  console.document(document_of(groups));
  return exit_done;
}

}  // namespace reprise::cli
