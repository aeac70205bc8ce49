// The unit and the up axis that takes are stored with, where nobody says them.
#pragma once

#include <vector>

#include "archive/take_identity.h"
#include "reprise/archive.h"

namespace reprise {

/// What a take's row of the metadata says goes before what is said of all takes.
ReadOptions read_options(const ReadOptions& all, const TakeMetadata* row);

/// What the readings of takes make one think.
struct ReadingReport {
  std::vector<AssumedUnit> assumed_units;      ///< by unit, guessed ones first
  std::vector<std::string> implausible_units;  ///< names of ASF/AMC takes, in order
};

/// Gives each take the reading (TakeReading) of its skeleton text: what `options` and its row say,
/// else what it is stored with if it is replaced, else what stored takes of the same text have,
/// else what all of `fresh` with the same text say together.
ReadingReport settle_readings(std::vector<FreshTake>& fresh, const ReadOptions& options,
                              const ArchiveStore* store);

}  // namespace reprise
