// The unit and the up axis that takes of a skeleton text are stored with.
#pragma once

#include <map>
#include <vector>

#include "reprise/query/take_reading.h"
#include "store/archive_store.h"

namespace reprise {

class StoredReadings {
 public:
  explicit StoredReadings(const ArchiveStore& store) : store_(store) {}

  /// Proportions of the same text: of several those that somebody gave a unit or an axis to, else
  /// the first. Null: none.
  const ProportionsRecord* of_text(const Skeleton& skeleton);

 private:
  const std::vector<ProportionsRecord>& of_skeleton(std::int64_t id);

  const ArchiveStore& store_;
  std::map<std::int64_t, std::vector<ProportionsRecord>> records_;  ///< by skeleton
};

/// Puts what is stored in the place of what was only assumed. What is stored of the take itself
/// (`its_own`) stays given if it was; of others it is assumed.
void take_over(const ProportionsRecord& stored, bool its_own, TakeReading& reading);

}  // namespace reprise
