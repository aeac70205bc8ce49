// The first look at every file of an ingest: which takes are new.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "archive/metadata.h"
#include "archive/reading_choice.h"
#include "archive/take_identity.h"
#include "reprise/error.h"

namespace reprise {

struct Survey {
  std::vector<FreshTake> fresh;      ///< to be stored
  std::vector<std::string> skipped;  ///< stored already
  /// Of `skipped`, as in IngestReport.
  std::vector<std::string> other_fidelity, other_metadata, other_reading;
  std::vector<SameSource> same_source;  ///< of `fresh`, as in IngestReport
  std::vector<InputNote> notes;         ///< of `fresh`
  std::vector<RejectedInput> rejected;
  ReadingReport readings;  ///< of `fresh`
};

/// Reads every file once and compares it with what `store` holds (null: nothing). All lists are in
/// the order of the files, whatever the number of threads. Takes that coding would need more than
/// `memory_bytes` for are rejected. `tick` hears of each file.
Survey survey_files(const std::vector<InputFile>& files, const IngestOptions& options,
                    const MetadataTable& metadata, const ArchiveStore* store,
                    std::size_t memory_bytes, const std::function<void(const std::string&)>& tick);

/// What a report says of a file that cannot be taken in.
RejectedInput rejection(const InputFile& file, const Error& error);

}  // namespace reprise
