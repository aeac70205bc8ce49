// Skeletons, proportions and spaces out of the archive, each held against its digest.
#include <algorithm>

#include "store/compression.h"
#include "store/store_impl.h"

namespace reprise {
namespace {

/// Largest texts and blobs that are taken out of an archive (bytes).
constexpr std::size_t most_text = std::size_t{1} << 28;
constexpr std::size_t most_blob = std::size_t{1} << 30;
/// Spaces that extend each other further than this were not made by an ingest.
constexpr std::size_t most_extensions = 1000;

[[noreturn]] void throw_damaged(const std::string& what) {
  throw Error(ErrorCode::damaged, "the archive is damaged: " + what + " is not as it was written");
}

template <class Array>
void expect_equal(const Bytes& stored, const Array& computed, const std::string& what) {
  if (!std::ranges::equal(stored, computed)) throw_damaged(what);
}

Digest to_digest(const Bytes& bytes, const std::string& what) {
  Digest digest{};
  if (bytes.size() != digest.size()) throw_damaged(what);
  std::copy(bytes.begin(), bytes.end(), digest.begin());
  return digest;
}

SkeletonRecord skeleton_row(Statement& row) {
  SkeletonRecord record;
  record.id = row.integer();
  const std::string what = "skeleton " + std::to_string(record.id);
  record.structure = to_digest(row.bytes(), what);
  record.format = static_cast<MotionFormat>(row.integer());
  record.joints = static_cast<std::size_t>(row.integer());
  record.channels = static_cast<std::size_t>(row.integer());
  record.root = row.text();
  expect_equal(row.bytes(), row_digest(record), what);
  return record;
}

constexpr const char* skeleton_columns =
    "SELECT id, structure, format, joints, channels, root, digest FROM skeletons";

}  // namespace

std::optional<SkeletonRecord> ArchiveStore::find_skeleton(const Digest& structure) const {
  Statement row = impl_->prepare(std::string(skeleton_columns) + " WHERE structure=?");
  row.bind(structure);
  if (!row.step()) return std::nullopt;
  return skeleton_row(row);
}

SkeletonRecord ArchiveStore::skeleton(std::int64_t id) const {
  Statement row = impl_->prepare(std::string(skeleton_columns) + " WHERE id=?");
  row.bind(id);
  if (!row.step()) throw_damaged("skeleton " + std::to_string(id));
  return skeleton_row(row);
}

std::optional<std::int64_t> ArchiveStore::find_proportions(const ProportionsRecord& record) const {
  Statement row = impl_->prepare("SELECT id FROM proportions WHERE skeleton=? AND identity=?");
  row.bind(record.skeleton).bind(proportions_identity(record));
  if (!row.step()) return std::nullopt;
  return row.integer();
}

ProportionsRecord ArchiveStore::proportions(std::int64_t id) const {
  const std::string what = "the proportions " + std::to_string(id);
  Statement row = impl_->prepare(
      "SELECT skeleton, unit_mm, up, frame_rate, assumed, asf_name, layout, text, identity, "
      "digest, "
      "(SELECT min(id) FROM proportions AS first WHERE first.skeleton=proportions.skeleton) "
      "FROM proportions WHERE id=?");
  row.bind(id);
  if (!row.step()) throw_damaged(what);
  ProportionsRecord record;
  record.id = id;
  record.skeleton = row.integer();
  record.millimetres_per_unit = row.real();
  const std::optional<UpAxis> up = up_of_row(row.integer());
  if (!up) throw_damaged(what);
  record.up = *up;
  record.frame_rate = row.real();
  const std::int64_t assumed = row.integer();
  record.frame_rate_assumed = (assumed & assumed_frame_rate) != 0;
  record.unit_assumed = (assumed & assumed_unit) != 0;
  record.up_assumed = (assumed & assumed_up) != 0;
  record.asf_name = row.text();
  record.layout = decompress(row.bytes(), most_text);
  const Bytes frame = row.bytes();
  const Bytes identity = row.bytes(), digest = row.bytes();
  const std::int64_t first = row.integer();
  const std::string prefix = first < id ? proportions(first).source_text : std::string();
  const Bytes text = decompress(frame, most_text, bytes_of(prefix));
  record.source_text.assign(text.begin(), text.end());
  record.identity = proportions_identity(record);
  expect_equal(identity, record.identity, what);
  expect_equal(digest, shortened(record.identity), what);
  return record;
}

ProportionsRecord ArchiveStore::reference_proportions(std::int64_t skeleton) const {
  Statement row = impl_->prepare("SELECT min(id) FROM proportions WHERE skeleton=?");
  row.bind(skeleton);
  row.step();
  return proportions(row.integer());
}

SpaceChain ArchiveStore::space_chain(std::int64_t id) const {
  SpaceChain chain;
  std::vector<std::pair<SpaceRecord, Bytes>> rows;
  std::int64_t next = id;
  do {
    const std::string what = "the coefficient space " + std::to_string(next);
    Statement row = impl_->prepare("SELECT skeleton, base, data, digest FROM spaces WHERE id=?");
    row.bind(next);
    if (!row.step() || rows.size() == most_extensions) throw_damaged(what);
    SpaceRecord record;
    record.id = next;
    record.skeleton = row.integer();
    record.base = row.integer();
    record.data = decompress(row.bytes(), most_blob);
    // A space only ever extends an older one: anything else would go round in circles.
    if (record.base < 0 || record.base >= next) throw_damaged(what);
    if (!rows.empty() && record.skeleton != rows.back().first.skeleton) throw_damaged(what);
    next = record.base;
    rows.emplace_back(std::move(record), row.bytes());
  } while (next != 0);
  const Digest structure = skeleton(rows.front().first.skeleton).structure;
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    chain.digest = space_digest(structure, chain.digest, row->first.data);
    expect_equal(row->second, chain.digest,
                 "the coefficient space " + std::to_string(row->first.id));
    chain.spaces.push_back(std::move(row->first));
  }
  return chain;
}

SpaceRecord ArchiveStore::space(std::int64_t id) const {
  return std::move(space_chain(id).spaces.back());
}

Digest ArchiveStore::digest_of_space(std::int64_t id) const { return space_chain(id).digest; }

std::vector<std::int64_t> ArchiveStore::proportions_of_skeleton(std::int64_t skeleton) const {
  Statement row = impl_->prepare("SELECT id FROM proportions WHERE skeleton=? ORDER BY id");
  row.bind(skeleton);
  std::vector<std::int64_t> ids;
  while (row.step()) ids.push_back(row.integer());
  return ids;
}

std::vector<std::int64_t> ArchiveStore::spaces_of_skeleton(std::int64_t skeleton) const {
  Statement row = impl_->prepare("SELECT id FROM spaces WHERE skeleton=? ORDER BY id");
  row.bind(skeleton);
  std::vector<std::int64_t> ids;
  while (row.step()) ids.push_back(row.integer());
  return ids;
}

}  // namespace reprise
