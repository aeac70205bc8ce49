// Where the errors of a whole archive are largest: take, joint, frame and time.
#pragma once

#include <optional>
#include <string>

#include "cli/json_output.h"

namespace reprise::cli {

struct WorstError {
  std::string take;
  std::string joint;
  long frame = 0;
  double time = 0;  ///< seconds
};

/// As recorded with the takes; nothing where nothing is off by anything.
struct WorstErrors {
  std::optional<WorstError> place, turn;
};
WorstErrors find_worst_errors(const Archive& archive, const ArchiveStats& stats);

/// Lines "worst place: TAKE, JOINT, frame F, T s", printable.
std::string worst_text(const WorstErrors& worst);
/// Adds "worst_place" and "worst_turn": {"take","joint","frame","time"}, or null.
void add_worst(const WorstErrors& worst, Json& document);
/// The document of `stats`.
Json stats_document(const ArchiveStats& stats, const WorstErrors& worst);

}  // namespace reprise::cli
