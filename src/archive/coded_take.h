// A new take as it will be stored: coded in all its layers, and cut into clips.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "archive/clip_plan.h"
#include "archive/space_builder.h"
#include "store/archive_store.h"

namespace reprise {

struct CodedTake {
  std::optional<RejectedInput> rejected;  ///< then nothing else holds
  bool kept = false;                      ///< within its fidelity; else the record is empty
  TakeRecord record;
  /// As planned, but not yet linked: all takes have to be stored first.
  std::vector<ClipRecord> clips;

  /// Coded motion, texts and all, in bytes.
  std::size_t bytes() const;
};

/// About what coding a take needs at most, in bytes; measured,
/// docs/findings/2026-11-27-long-takes.md.
std::size_t coding_memory(const Skeleton& skeleton, long frames);

/// Reads the take's file again and codes it on the space assigned to it. May be called from several
/// threads. What is wrong with the file is in `rejected`; throws Error for everything else.
CodedTake code_take(const FreshTake& fresh, const SpaceAssignment& assignment, const ClipPlan& plan,
                    const IngestOptions& options);

}  // namespace reprise
