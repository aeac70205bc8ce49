// Counts, sizes and lists over a whole archive.
#include <algorithm>
#include <cmath>
#include <set>

#include "store/store_impl.h"

namespace reprise {
namespace {

std::int64_t number(const Database& database, const std::string& sql) {
  Statement row(database, sql);
  return row.step() ? row.integer() : 0;
}

}  // namespace

std::vector<SkeletonInfo> ArchiveStore::skeletons() const {
  std::map<std::int64_t, std::size_t> takes;
  for_each_take([&](const TakeRecord& take) { ++takes[take.info.skeleton]; });
  std::vector<SkeletonInfo> result;
  Statement ids = impl_->prepare("SELECT id FROM skeletons ORDER BY id");
  while (ids.step()) {
    const SkeletonRecord record = skeleton(ids.integer());
    SkeletonInfo info{record.id, record.format, record.joints, record.channels, 0, 0, record.root};
    info.takes = takes[record.id];
    Statement actors = impl_->prepare("SELECT count(*) FROM proportions WHERE skeleton=?");
    actors.bind(record.id);
    if (actors.step()) info.proportions = static_cast<std::size_t>(actors.integer());
    result.push_back(info);
  }
  return result;
}

std::vector<std::string> ArchiveStore::subjects() const {
  std::set<std::string> names;
  for_each_take([&](const TakeRecord& take) { names.insert(take.info.subject); });
  names.erase("");
  return {names.begin(), names.end()};
}

ArchiveStats ArchiveStore::stats(
    const std::function<void(const TakeRecord&, std::uint64_t)>& sketch) const {
  ArchiveStats stats;
  double sum = 0, squares = 0, turns = 0, distances = 0;
  std::map<std::int64_t, std::size_t> joints;
  std::uint64_t motion = 0;
  for_each_take([&](const TakeRecord& record) {
    const TakeInfo& info = record.info;
    if (!joints.contains(info.skeleton)) joints[info.skeleton] = skeleton(info.skeleton).joints;
    const auto weight =
        static_cast<std::uint64_t>(info.frames) * static_cast<std::uint64_t>(joints[info.skeleton]);
    ++stats.takes;
    stats.frames += static_cast<std::uint64_t>(info.frames);
    stats.seconds += info.seconds();
    stats.raw_bytes += info.raw_bytes;
    stats.text_bytes += info.text_bytes;
    motion += info.payload_bytes;
    for (const auto& [name, size] : record.spent) stats.bytes[name] += size;
    ++stats.fidelity[tier_name(info.fidelity.tier)];
    sum += info.error_mm.mean * static_cast<double>(weight);
    squares += info.error_mm.rms * info.error_mm.rms * static_cast<double>(weight);
    distances += static_cast<double>(weight);
    turns += info.rotation_deg.mean * static_cast<double>(weight);
    if (info.error_mm.max > stats.error_mm.max) {
      stats.error_mm.max = info.error_mm.max;
      stats.worst_place_take = info.name;
    }
    if (info.rotation_deg.max > stats.rotation_deg.max) {
      stats.rotation_deg.max = info.rotation_deg.max;
      stats.worst_turn_take = info.name;
    }
    sketch(record, weight);
  });
  if (distances > 0) {
    stats.error_mm.mean = sum / distances;
    stats.error_mm.rms = std::sqrt(squares / distances);
    stats.rotation_deg.mean = turns / distances;
  }
  stats.subjects = subjects().size();
  stats.skeletons = joints.size();
  count_clips(stats);
  count_bytes(stats, motion);
  return stats;
}

void ArchiveStore::count_clips(ArchiveStats& stats) const {
  std::set<std::int64_t> groups;
  const auto count = [&](const StoredClip& clip) {
    ++(clip.kind == ClipKind::primary    ? stats.primary_clips
       : clip.kind == ClipKind::repeated ? stats.repeated_clips
                                         : stats.unique_clips);
    if (clip.group != 0) groups.insert(clip.group);
  };
  impl_->for_each_block([&](const TakeBlock& block) {
    for (const StoredTake& take : block.takes) {
      for (const StoredClip& clip : take.clips) count(clip);
    }
  });
  stats.groups = groups.size();
}

/// What the bytes of the file are spent on; `motion` is what layers take up.
void ArchiveStore::count_bytes(ArchiveStats& stats, std::uint64_t motion) const {
  const Database& database = *impl_->database;
  std::uint64_t coded = 0;
  for (const auto& [name, size] : stats.bytes) coded += size;
  stats.bytes["axes"] = static_cast<std::uint64_t>(
      number(database, "SELECT coalesce(sum(length(data)), 0) FROM spaces"));
  stats.bytes["skeletons"] = static_cast<std::uint64_t>(
      number(database, "SELECT coalesce(sum(length(text) + length(layout)), 0) FROM proportions"));
  stats.bytes["frames"] = motion - std::min(coded, motion);
  stats.payload_bytes = motion + stats.bytes["axes"] + stats.bytes["skeletons"];
  stats.archive_bytes = std::filesystem::file_size(database.path());
  stats.bytes["tables"] = stats.archive_bytes - std::min(stats.archive_bytes, stats.payload_bytes);
}

Digest ArchiveStore::content_digest() const {
  Statement row = impl_->prepare("SELECT value FROM meta WHERE key='content'");
  Hasher hasher;
  if (row.step()) hasher.add_bytes(row.bytes());
  std::int64_t takes = 0;
  impl_->for_each_block(
      [&](const TakeBlock& block) { takes += static_cast<std::int64_t>(block.takes.size()); });
  hasher.add_number(takes);
  return hasher.finish();
}

std::string ArchiveStore::written_by() const {
  Statement row = impl_->prepare("SELECT value FROM meta WHERE key='written_by'");
  return row.step() ? row.text() : std::string();
}

}  // namespace reprise
