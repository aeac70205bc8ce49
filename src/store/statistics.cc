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

bool ArchiveStore::empty() const {
  return number(*impl_->database, "SELECT count(*) FROM sqlite_schema") == 0;
}

std::vector<SkeletonInfo> ArchiveStore::skeletons() const {
  std::vector<SkeletonInfo> result;
  Statement ids = impl_->prepare("SELECT id FROM skeletons ORDER BY id");
  while (ids.step()) {
    const SkeletonRecord record = skeleton(ids.integer());
    SkeletonInfo info{record.id, record.format, record.joints, record.channels, 0, 0, record.root};
    Statement takes = impl_->prepare(
        "SELECT count(*) FROM takes JOIN proportions ON proportions.id=takes.proportions WHERE "
        "skeleton=?");
    takes.bind(record.id);
    if (takes.step()) info.takes = static_cast<std::size_t>(takes.integer());
    Statement actors = impl_->prepare("SELECT count(*) FROM proportions WHERE skeleton=?");
    actors.bind(record.id);
    if (actors.step()) info.proportions = static_cast<std::size_t>(actors.integer());
    result.push_back(info);
  }
  return result;
}

std::vector<std::string> ArchiveStore::subjects() const {
  std::vector<std::string> names;
  Statement row = impl_->prepare("SELECT name FROM subjects ORDER BY name");
  while (row.step()) names.push_back(row.text());
  return names;
}

ArchiveStats ArchiveStore::stats(
    const std::function<void(const Bytes&, std::uint64_t)>& sketch) const {
  const Database& database = *impl_->database;
  ArchiveStats stats;
  double sum = 0, squares = 0, distances = 0;
  std::map<std::int64_t, std::size_t> joints;
  std::set<std::int64_t> skeletons_seen;
  std::uint64_t motion = 0;
  Statement ids(database, "SELECT id FROM takes");
  while (ids.step()) {
    const TakeRecord record = take(ids.integer());
    const TakeInfo& info = record.info;
    if (skeletons_seen.insert(info.skeleton).second) {
      joints[info.skeleton] = skeleton(info.skeleton).joints;
    }
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
    stats.error_mm.max = std::max(stats.error_mm.max, info.error_mm.max);
    sketch(record.error_quantiles, weight);
  }
  if (distances > 0) {
    stats.error_mm.mean = sum / distances;
    stats.error_mm.rms = std::sqrt(squares / distances);
  }
  stats.subjects = subjects().size();
  stats.skeletons = skeletons_seen.size();
  for (const ClipKind kind : {ClipKind::primary, ClipKind::repeated, ClipKind::unique}) {
    const auto count =
        static_cast<std::size_t>(number(database, "SELECT count(*) FROM clips WHERE kind=" +
                                                      std::to_string(static_cast<int>(kind))));
    (kind == ClipKind::primary    ? stats.primary_clips
     : kind == ClipKind::repeated ? stats.repeated_clips
                                  : stats.unique_clips) = count;
  }
  stats.groups = static_cast<std::size_t>(
      number(database, "SELECT count(DISTINCT family) FROM clips WHERE family<>0"));
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
  return stats;
}

Digest ArchiveStore::content_digest() const {
  Statement row = impl_->prepare("SELECT value FROM meta WHERE key='content'");
  Hasher hasher;
  if (row.step()) hasher.add_bytes(row.bytes());
  hasher.add_number(number(*impl_->database, "SELECT count(*) FROM takes"));
  return hasher.finish();
}

std::string ArchiveStore::written_by() const {
  Statement row = impl_->prepare("SELECT value FROM meta WHERE key='written_by'");
  return row.step() ? row.text() : std::string();
}

}  // namespace reprise
