#include "archive/reading_choice.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "query/stored_readings.h"
#include "store/digest.h"

namespace reprise {
namespace {

/// Takes that are read in one way: of one text, and of whom the same was said.
struct GroupKey {
  Digest text{};
  std::optional<double> unit_mm;
  std::optional<UpAxis> up;

  friend auto operator<=>(const GroupKey&, const GroupKey&) = default;
};

struct Group {
  std::vector<std::size_t> members;
  std::vector<ReadingEvidence> evidence;
};

/// What the take itself is stored with, if its text is still the same.
std::optional<ProportionsRecord> stored_of_take(const ArchiveStore* store, const FreshTake& fresh) {
  if (store == nullptr || !fresh.replaces) return std::nullopt;
  const std::optional<TakeRecord> stored = store->find_take(fresh.file.name);
  if (!stored) return std::nullopt;
  ProportionsRecord record = store->proportions(stored->proportions);
  if (record.source_text != fresh.outline.skeleton->source_text) return std::nullopt;
  return record;
}

class UnitTally {
 public:
  void add(const FreshTake& fresh, const TakeReading& reading) {
    if (fresh.outline.skeleton->format == MotionFormat::asf_amc) {
      if (reading.height_mm && !reading.is_plausible()) {
        report_.implausible_units.push_back(fresh.file.name);
      }
      return;
    }
    if (!reading.unit_assumed) return;
    const bool guessed = reading.is_plausible();
    AssumedUnit& unit = units_[{!guessed, reading.millimetres_per_unit}];
    unit.unit_mm = reading.millimetres_per_unit;
    if (guessed) {
      const double height = *reading.height_mm;
      unit.least_height_mm = unit.takes == 0 ? height : std::min(unit.least_height_mm, height);
      unit.greatest_height_mm = std::max(unit.greatest_height_mm, height);
    }
    ++unit.takes;
  }

  ReadingReport finish() {
    for (const auto& [key, unit] : units_) report_.assumed_units.push_back(unit);
    return std::move(report_);
  }

 private:
  std::map<std::pair<bool, double>, AssumedUnit> units_;
  ReadingReport report_;
};

}  // namespace

ReadOptions read_options(const ReadOptions& all, const TakeMetadata* row) {
  ReadOptions options = all;
  if (row == nullptr) return options;
  if (row->unit_mm) options.bvh_millimetres_per_unit = row->unit_mm;
  if (row->frame_rate) options.frame_rate = row->frame_rate;
  return options;
}

ReadingReport settle_readings(std::vector<FreshTake>& fresh, const ReadOptions& options,
                              const ArchiveStore* store) {
  std::map<GroupKey, Group> groups;
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    const ReadOptions said = read_options(options, &fresh[i].metadata);
    const Digest digest = digest_of(fresh[i].outline.skeleton->source_text);
    Group& group = groups[{digest, said.bvh_millimetres_per_unit, said.up}];
    group.members.push_back(i);
    group.evidence.push_back(fresh[i].outline.reading_evidence);
  }
  std::optional<StoredReadings> stored;
  if (store != nullptr) stored.emplace(*store);
  std::map<std::size_t, TakeReading> readings;  // in the order of takes
  for (const auto& [key, group] : groups) {
    const FreshTake& first = fresh[group.members.front()];
    ReadOptions said = options;
    said.bvh_millimetres_per_unit = key.unit_mm;
    const TakeReading found = find_reading(*first.outline.skeleton, group.evidence, said);
    const ProportionsRecord* known = stored ? stored->of_text(*first.outline.skeleton) : nullptr;
    for (const std::size_t i : group.members) {
      TakeReading reading = found;
      if (const std::optional<ProportionsRecord> own = stored_of_take(store, fresh[i])) {
        take_over(*own, true, reading);
      } else if (known != nullptr) {
        take_over(*known, false, reading);
      }
      readings[i] = reading;
    }
  }
  UnitTally tally;
  for (const auto& [i, reading] : readings) {
    read_as(fresh[i].outline, reading);
    tally.add(fresh[i], reading);
  }
  return tally.finish();
}

}  // namespace reprise
