#include "cli/list_command.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "cli/json_output.h"
#include "cli/text.h"
#include "reprise/error.h"

namespace reprise::cli {
namespace {

using enum Table::Align;

std::string takes_table(const std::vector<TakeInfo>& takes, bool bold) {
  Table table({{"TAKE", left},
               {"SUBJECT", left},
               {"FORMAT", left},
               {"FRAMES", right},
               {"RATE", right},
               {"LENGTH", right},
               {"UNIT MM", right},
               {"UP", left},
               {"FIDELITY", left},
               {"PAYLOAD", right},
               {"RATIO", right},
               {"MEAN MM", right}});
  for (const TakeInfo& take : takes) {
    table.add({take.name, take.subject, format_name(take.format), std::to_string(take.frames),
               format_number(take.frame_rate, 2), format_number(take.seconds(), 2),
               fmt::format("{:.6g}", take.unit_mm), std::string(up_axis_name(take.up)),
               tier_name(take.fidelity.tier), format_size(take.payload_bytes),
               format_ratio(take.raw_bytes, take.payload_bytes),
               format_number(take.error_mm.mean, 2)});
  }
  return table.text(bold);
}

std::string clips_table(const std::vector<ClipInfo>& clips, bool bold) {
  Table table({{"CLIP", left},
               {"TAKE", left},
               {"KIND", left},
               {"GROUP", right},
               {"START", right},
               {"END", right},
               {"FRAMES", right},
               {"PRIMARY", left},
               {"SIZE", right}});
  for (const ClipInfo& clip : clips) {
    table.add({clip.id, clip.take, clip_kind_name(clip.kind), std::to_string(clip.group),
               format_number(clip.start, 2), format_number(clip.end, 2),
               std::to_string(clip.frames), clip.primary, format_size(clip.bytes)});
  }
  return table.text(bold);
}

/// What the clips of one behaviour group are.
struct GroupSummary {
  std::size_t primary = 0, repeated = 0, unique = 0;
  std::set<std::string> takes, subjects;
  double seconds = 0;
};

std::map<std::int64_t, GroupSummary> groups_of(const Archive& archive, const TakeFilter& filter) {
  std::map<std::string, std::string> subjects;
  for (const TakeInfo& take : archive.takes(filter)) subjects[take.name] = take.subject;
  std::map<std::int64_t, GroupSummary> groups;
  for (const ClipInfo& clip : archive.clips(filter)) {
    GroupSummary& group = groups[clip.group];
    ++(clip.kind == ClipKind::primary    ? group.primary
       : clip.kind == ClipKind::repeated ? group.repeated
                                         : group.unique);
    group.takes.insert(clip.take);
    if (const std::string& subject = subjects[clip.take]; !subject.empty())
      group.subjects.insert(subject);
    group.seconds += clip.end - clip.start;
  }
  return groups;
}

std::string groups_table(const std::map<std::int64_t, GroupSummary>& groups, bool bold) {
  Table table({{"GROUP", right},
               {"TAKES", right},
               {"SUBJECTS", right},
               {"PRIMARY", right},
               {"REPEATED", right},
               {"UNIQUE", right},
               {"LENGTH", right}});
  for (const auto& [id, group] : groups) {
    table.add({std::to_string(id), std::to_string(group.takes.size()),
               std::to_string(group.subjects.size()), std::to_string(group.primary),
               std::to_string(group.repeated), std::to_string(group.unique),
               format_number(group.seconds, 2)});
  }
  return table.text(bold);
}

Json document_of(const std::map<std::int64_t, GroupSummary>& groups) {
  Json entries = Json::array();
  for (const auto& [id, group] : groups) {
    entries.push_back(
        {{"id", id},
         {"takes", group.takes.size()},
         {"subjects", group.subjects.size()},
         {"clips",
          {{"primary", group.primary}, {"repeated", group.repeated}, {"unique", group.unique}}},
         {"seconds", group.seconds}});
  }
  return {{"groups", entries}};
}

std::string skeletons_table(const std::vector<SkeletonInfo>& skeletons, bool bold) {
  Table table({{"SKELETON", right},
               {"FORMAT", left},
               {"ROOT", left},
               {"JOINTS", right},
               {"CHANNELS", right},
               {"TAKES", right},
               {"PROPORTIONS", right}});
  for (const SkeletonInfo& skeleton : skeletons) {
    table.add({std::to_string(skeleton.id), format_name(skeleton.format), skeleton.root,
               std::to_string(skeleton.joints), std::to_string(skeleton.channels),
               std::to_string(skeleton.takes), std::to_string(skeleton.proportions)});
  }
  return table.text(bold);
}

/// Takes with the joints in which their errors are largest.
Json takes_document(const Archive& archive, const std::vector<TakeInfo>& takes) {
  std::map<std::int64_t, std::shared_ptr<const Skeleton>> skeletons;
  Json entries = Json::array();
  for (const TakeInfo& take : takes) {
    // Joints have the same names in all takes of a skeleton.
    auto& skeleton = skeletons[take.skeleton];
    if (skeleton == nullptr) skeleton = archive.skeleton(take);
    entries.push_back(to_json(take, *skeleton));
  }
  return {{"takes", entries}};
}

template <typename Record>
Json document_of(const char* name, const std::vector<Record>& records) {
  Json entries = Json::array();
  for (const Record& record : records) entries.push_back(to_json(record));
  return {{name, entries}};
}

ClipKind parse_kind(const std::string& text) {
  for (const ClipKind kind : {ClipKind::primary, ClipKind::repeated, ClipKind::unique}) {
    if (text == clip_kind_name(kind)) return kind;
  }
  throw Error(ErrorCode::usage,
              "--kind takes primary, repeated or unique, not \"" + printable(text) + "\"");
}

}  // namespace

void ListCommand::setup(CLI::App& app) {
  add_archive(app, archive_);
  app.add_flag("--clips", clips_, "List clips instead of takes");
  app.add_flag("--groups", groups_, "List behaviour groups instead of takes");
  app.add_flag("--skeletons", skeletons_, "List skeletons instead of takes");
  add_text(app, "--take", filter_.take, "Only of this take: its name or the end of it", "NAME");
  add_text(app, "--subject", filter_.subject, "Only of this subject", "NAME");
  app.add_option_function<std::string>(
         "--kind", [this](const std::string& text) { filter_.kind = parse_kind(text); },
         "Only clips of this kind, or takes that have one: primary, repeated, unique")
      ->type_name("KIND");
  add_text(app, "--text", filter_.text,
           "Only takes with these words in their name, subject, description or tags", "WORDS");
  add_examples(app, {"reprise list lib.rpz", "reprise list lib.rpz --clips --take walk_01",
                     "reprise list lib.rpz --text \"slow walk\" --json"});
}

void ListCommand::check() {
  if (int{clips_} + int{groups_} + int{skeletons_} > 1) {
    throw Error(ErrorCode::usage, "--clips, --groups and --skeletons exclude each other");
  }
  const bool filtered = !filter_.take.empty() || !filter_.subject.empty() ||
                        !filter_.text.empty() || filter_.kind.has_value();
  if (skeletons_ && filtered) {
    throw Error(ErrorCode::usage,
                "the filters are for takes, clips and groups, not for --skeletons");
  }
}

ExitCode ListCommand::run(Console& console) {
  const Archive archive(archive_);
  const bool bold = console.bold_results();
  if (clips_) {
    const auto clips = archive.clips(filter_);
    console.result(clips_table(clips, bold));
    console.document(document_of("clips", clips));
  } else if (groups_) {
    const auto groups = groups_of(archive, filter_);
    console.result(groups_table(groups, bold));
    console.document(document_of(groups));
  } else if (skeletons_) {
    const auto skeletons = archive.skeletons();
    console.result(skeletons_table(skeletons, bold));
    console.document(document_of("skeletons", skeletons));
  } else {
    const auto takes = archive.takes(filter_);
    console.result(takes_table(takes, bold));
    if (console.json()) console.document(takes_document(archive, takes));
  }
  return exit_done;
}

}  // namespace reprise::cli
