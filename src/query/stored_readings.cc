#include "query/stored_readings.h"

#include "store/digest.h"

namespace reprise {
namespace {

/// The least of proportions of one text counts.
int rank(const ProportionsRecord& record) {
  return (record.unit_assumed ? 2 : 0) + (record.up_assumed ? 1 : 0);
}

}  // namespace

const ProportionsRecord* StoredReadings::of_text(const Skeleton& skeleton) {
  const Digest structure = digest_of(structure_bytes(skeleton));
  const std::optional<SkeletonRecord> known = store_.find_skeleton(structure);
  if (!known) return nullptr;
  const ProportionsRecord* found = nullptr;
  for (const ProportionsRecord& record : of_skeleton(known->id)) {
    if (record.source_text != skeleton.source_text) continue;
    if (found == nullptr || rank(record) < rank(*found)) found = &record;
  }
  return found;
}

const std::vector<ProportionsRecord>& StoredReadings::of_skeleton(std::int64_t id) {
  const auto [known, fresh] = records_.try_emplace(id);
  if (fresh) {
    for (const std::int64_t proportions : store_.proportions_of_skeleton(id)) {
      known->second.push_back(store_.proportions(proportions));
    }
  }
  return known->second;
}

void take_over(const ProportionsRecord& stored, bool its_own, TakeReading& reading) {
  if (reading.unit_assumed) {
    if (reading.height_mm) {
      *reading.height_mm *= stored.millimetres_per_unit / reading.millimetres_per_unit;
    }
    reading.millimetres_per_unit = stored.millimetres_per_unit;
    reading.unit_assumed = !its_own || stored.unit_assumed;
  }
  if (reading.up_assumed) {
    reading.up = stored.up;
    reading.up_assumed = !its_own || stored.up_assumed;
  }
}

void read_as_stored(Take& take, const ReadOptions& options, const std::filesystem::path& archive) {
  const ReadingEvidence evidence = reading_evidence(take);
  TakeReading reading = find_reading(*take.skeleton, {&evidence, 1}, options);
  const ArchiveStore store = ArchiveStore::open_for_reading(archive);
  const auto snapshot = store.snapshot();
  StoredReadings readings(store);
  if (const ProportionsRecord* stored = readings.of_text(*take.skeleton)) {
    take_over(*stored, false, reading);
  }
  take.skeleton = read_as(*take.skeleton, reading);
}

}  // namespace reprise
