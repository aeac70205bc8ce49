#include "cli/worst_errors.h"

#include <fmt/format.h>

#include "cli/text.h"
#include "reprise/error.h"

namespace reprise::cli {
namespace {

std::optional<WorstError> worst_of(const Archive& archive, const std::string& name,
                                   JointAt TakeInfo::*where) {
  if (name.empty()) return std::nullopt;
  try {
    const TakeInfo take = archive.find_take(name);
    const JointAt& at = take.*where;
    return WorstError{name, joint_label(*archive.skeleton(take), at.joint), at.frame,
                      static_cast<double>(at.frame) / take.frame_rate};
  } catch (const Error& error) {
    // A writer may have taken it out meanwhile.
    if (error.code() != ErrorCode::not_found) throw;
    return std::nullopt;
  }
}

std::string worst_line(const char* what, const std::optional<WorstError>& worst) {
  if (!worst) return {};
  return printable(fmt::format("worst {}: {}, {}, frame {}, {:.3f} s", what, worst->take,
                               worst->joint, worst->frame, worst->time)) +
         "\n";
}

Json json_of(const std::optional<WorstError>& worst) {
  if (!worst) return nullptr;
  return {{"take", worst->take},
          {"joint", worst->joint},
          {"frame", worst->frame},
          {"time", worst->time}};
}

}  // namespace

WorstErrors find_worst_errors(const Archive& archive, const ArchiveStats& stats) {
  return {worst_of(archive, stats.worst_place_take, &TakeInfo::worst_place),
          worst_of(archive, stats.worst_turn_take, &TakeInfo::worst_turn)};
}

std::string worst_text(const WorstErrors& worst) {
  return worst_line("place", worst.place) + worst_line("turn", worst.turn);
}

void add_worst(const WorstErrors& worst, Json& document) {
  document["worst_place"] = json_of(worst.place);
  document["worst_turn"] = json_of(worst.turn);
}

Json stats_document(const ArchiveStats& stats, const WorstErrors& worst) {
  Json document = to_json(stats);
  add_worst(worst, document);
  return document;
}

}  // namespace reprise::cli
