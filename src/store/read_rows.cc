// Rows out of the archive, each held against its digest.
#include <algorithm>
#include <cassert>

#include "store/compression.h"
#include "store/store_impl.h"

namespace reprise {
namespace {

/// Largest texts and blobs that are taken out of an archive (bytes).
constexpr std::size_t most_text = std::size_t{1} << 28;
constexpr std::size_t most_blob = std::size_t{1} << 30;

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

ClipRecord clip_row(Statement& row) {
  ClipRecord clip;
  clip.id = address_of(row.integer());
  clip.take = row.integer();
  clip.first_frame = static_cast<long>(row.integer());
  clip.frames = static_cast<long>(row.integer());
  clip.kind = static_cast<ClipKind>(row.integer());
  clip.group = row.integer();
  clip.primary = static_cast<std::uint64_t>(row.integer());
  clip.bytes = static_cast<std::uint64_t>(row.integer());
  return clip;
}

constexpr const char* clip_columns =
    "SELECT address, take, first_frame, frames, kind, family, primary_clip, bytes FROM clips";

/// Everything of a take but its motion. The columns that digests do not cover by value (what the
/// joined rows say) are covered by those rows' own digests, which are held against what is read
/// from them.
constexpr const char* take_columns =
    "SELECT takes.id, leaf, folder, coalesce(subjects.name, ''), takes.proportions, space, frames, "
    "tier, "
    "limit_mm, text_bytes, mean_um, rms_um, p99_um, max_um, sketch, spent, source, layers, "
    "takes.digest, "
    "coalesce(texts.description, ''), coalesce(texts.tags, ''), proportions.skeleton, "
    "proportions.frame_rate, proportions.assumed, skeletons.format, skeletons.channels, "
    "(SELECT sum(length(data)) FROM blobs WHERE blobs.id BETWEEN takes.id*8 AND takes.id*8+7) "
    "FROM takes LEFT JOIN proportions ON proportions.id=takes.proportions "
    "LEFT JOIN skeletons ON skeletons.id=proportions.skeleton LEFT JOIN subjects ON "
    "subjects.id=takes.subject LEFT JOIN texts ON texts.take=takes.id";

TakeRecord take_row(Statement& row) {
  TakeRecord record;
  TakeInfo& info = record.info;
  info.id = row.integer();
  const std::string leaf = row.text();
  info.name = join_name(row.text(), leaf);
  info.subject = row.text();
  record.proportions = row.integer();
  record.space = row.integer();
  info.frames = static_cast<long>(row.integer());
  info.fidelity.tier = static_cast<FidelityTier>(row.integer());
  info.fidelity.limit_mm = row.real();
  info.text_bytes = static_cast<std::uint64_t>(row.integer());
  const auto millimetres = [&] { return static_cast<double>(row.integer()) / 1000.0; };
  info.error_mm.mean = millimetres();
  info.error_mm.rms = millimetres();
  info.error_mm.p99 = millimetres();
  info.error_mm.max = millimetres();
  record.error_quantiles = row.bytes();
  record.spent = unpack_spent(row.bytes());
  info.source_digest = hexadecimal(row.bytes());
  const Bytes layers = row.bytes();
  const Bytes digest = row.bytes();
  info.description = row.text();
  info.tags = row.text();
  expect_equal(digest, row_digest(record, layers), "take '" + info.name + "'");
  std::optional<LayerTable> table = unpack_layers(layers);
  if (!table) throw_damaged("take '" + info.name + "'");
  record.layers = std::move(table->layers);
  info.skeleton = row.integer();
  info.frame_rate = row.real();
  info.frame_rate_assumed = row.integer() != 0;
  info.format = static_cast<MotionFormat>(row.integer());
  info.raw_bytes =
      4 * static_cast<std::uint64_t>(row.integer()) * static_cast<std::uint64_t>(info.frames);
  info.payload_bytes = static_cast<std::uint64_t>(row.integer());
  return record;
}

/// Text for FTS5 in which every word must be found, whatever signs are in it.
std::string all_words(const std::string& text) {
  std::string query, word;
  for (const char c : text + " ") {
    if (c != ' ' && c != '\t') {
      word += c;
      if (c == '"') word += c;
      continue;
    }
    if (!word.empty()) query += (query.empty() ? "" : " AND ") + ("\"" + word + "\"");
    word.clear();
  }
  return query;
}

/// Takes whose words match, searched with FTS5 in a table that lives only in memory: nothing that
/// is stored can be out of date or damaged.
std::vector<TakeInfo> matching(const Database& database, const std::vector<TakeInfo>& takes,
                               const std::string& text) {
  Statement(database,
            "CREATE VIRTUAL TABLE temp.words USING fts5(name, subject, description, tags)")
      .run();
  for (std::size_t i = 0; i < takes.size(); ++i) {
    Statement(database,
              "INSERT INTO temp.words(rowid, name, subject, description, tags) VALUES(?,?,?,?,?)")
        .bind(static_cast<std::int64_t>(i))
        .bind(takes[i].name)
        .bind(takes[i].subject)
        .bind(takes[i].description)
        .bind(takes[i].tags)
        .run();
  }
  std::vector<TakeInfo> result;
  {
    Statement found(database, "SELECT rowid FROM temp.words WHERE words MATCH ? ORDER BY rowid");
    found.bind(all_words(text));
    while (found.step()) result.push_back(takes[static_cast<std::size_t>(found.integer())]);
  }
  Statement(database, "DROP TABLE temp.words").run();
  return result;
}

}  // namespace

std::optional<SkeletonRecord> ArchiveStore::find_skeleton(const Digest& structure) const {
  // There are no tables yet in an archive that is being begun.
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
      "SELECT skeleton, unit_mm, frame_rate, assumed, asf_name, layout, text, identity, digest, "
      "(SELECT min(id) FROM proportions AS first WHERE first.skeleton=proportions.skeleton) "
      "FROM proportions WHERE id=?");
  row.bind(id);
  if (!row.step()) throw_damaged(what);
  ProportionsRecord record;
  record.id = id;
  record.skeleton = row.integer();
  record.millimetres_per_unit = row.real();
  record.frame_rate = row.real();
  record.frame_rate_assumed = row.integer() != 0;
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

Digest ArchiveStore::digest_of_space(std::int64_t id) const {
  const SpaceRecord record = space(id);
  Digest base{};
  if (record.base != 0) base = digest_of_space(record.base);
  return space_digest(skeleton(record.skeleton).structure, base, record.data);
}

SpaceRecord ArchiveStore::space(std::int64_t id) const {
  const std::string what = "the coefficient space " + std::to_string(id);
  Statement row = impl_->prepare("SELECT skeleton, base, data, digest FROM spaces WHERE id=?");
  row.bind(id);
  if (!row.step()) throw_damaged(what);
  SpaceRecord record;
  record.id = id;
  record.skeleton = row.integer();
  record.base = row.integer();
  record.data = decompress(row.bytes(), most_blob);
  // A space only ever extends an older one: anything else would go round in circles.
  if (record.base < 0 || record.base >= id) throw_damaged(what);
  Digest base{};
  if (record.base != 0) base = digest_of_space(record.base);
  expect_equal(row.bytes(), space_digest(skeleton(record.skeleton).structure, base, record.data),
               what);
  return record;
}

std::vector<std::int64_t> ArchiveStore::spaces_of_skeleton(std::int64_t skeleton) const {
  Statement row = impl_->prepare("SELECT id FROM spaces WHERE skeleton=? ORDER BY id");
  row.bind(skeleton);
  std::vector<std::int64_t> ids;
  while (row.step()) ids.push_back(row.integer());
  return ids;
}

std::optional<TakeRecord> ArchiveStore::find_take(const std::string& name) const {
  if (empty()) return std::nullopt;
  const auto [folder, leaf] = split_name(name);
  Statement row = impl_->prepare(std::string(take_columns) + " WHERE leaf=? AND folder=?");
  row.bind(leaf).bind(folder);
  if (!row.step()) return std::nullopt;
  return take_row(row);
}

TakeRecord ArchiveStore::take(std::int64_t id) const {
  Statement row = impl_->prepare(std::string(take_columns) + " WHERE takes.id=?");
  row.bind(id);
  if (!row.step()) throw_damaged("take " + std::to_string(id));
  return take_row(row);
}

Bytes ArchiveStore::layer(std::int64_t take, std::size_t index) const {
  const std::string what = "the motion of take " + std::to_string(take);
  Statement row =
      impl_->prepare("SELECT data, layers FROM takes JOIN blobs ON blobs.id=? WHERE takes.id=?");
  row.bind(blob_row(take, index)).bind(take);
  if (!row.step()) throw_damaged(what);
  const Bytes data = decompress(row.bytes(), most_blob);
  const std::optional<LayerTable> table = unpack_layers(row.bytes());
  if (!table || index >= table->digests.size()) throw_damaged(what);
  if (table->digests[index] != shortened(digest_of(data))) throw_damaged(what);
  return data;
}

std::vector<std::string> ArchiveStore::take_names_ending_in(const std::string& tail,
                                                            std::size_t most) const {
  const auto [folder, leaf] = split_name(tail);
  Statement row = impl_->prepare("SELECT leaf, folder FROM takes WHERE leaf=? ORDER BY folder");
  row.bind(leaf);
  std::vector<std::string> names;
  while (names.size() < most && row.step()) {
    const std::string own_leaf = row.text(), own_folder = row.text();
    const bool whole = own_folder == folder || folder.empty();
    if (whole || own_folder.ends_with("/" + folder))
      names.push_back(join_name(own_folder, own_leaf));
  }
  return names;
}

std::vector<TakeInfo> ArchiveStore::takes(const TakeFilter& filter) const {
  std::string sql = take_columns;
  std::string glue = " WHERE ";
  const auto condition = [&](const std::string& text) {
    sql += glue + text;
    glue = " AND ";
  };
  if (!filter.take.empty()) condition("leaf=?");
  if (!filter.subject.empty()) condition("subjects.name=?");
  if (filter.kind) condition("EXISTS(SELECT 1 FROM clips WHERE clips.take=takes.id AND kind=?)");
  Statement row = impl_->prepare(sql);
  if (!filter.take.empty()) row.bind(split_name(filter.take).second);
  if (!filter.subject.empty()) row.bind(filter.subject);
  if (filter.kind) row.bind(std::int64_t{static_cast<int>(*filter.kind)});
  std::vector<TakeInfo> takes;
  while (row.step()) {
    TakeInfo info = take_row(row).info;
    const bool fits =
        filter.take.empty() || info.name == filter.take || info.name.ends_with("/" + filter.take);
    if (fits) takes.push_back(std::move(info));
  }
  std::ranges::sort(takes, {}, &TakeInfo::name);
  return filter.text.empty() ? takes : matching(*impl_->database, takes, filter.text);
}

std::vector<ClipRecord> ArchiveStore::clips(std::span<const std::int64_t> takes) const {
  std::vector<ClipRecord> clips;
  for (const std::int64_t take : takes) {
    Statement row =
        impl_->prepare(std::string(clip_columns) + " WHERE take=? ORDER BY first_frame");
    row.bind(take);
    while (row.step()) clips.push_back(clip_row(row));
  }
  return clips;
}

std::vector<ClipRecord> ArchiveStore::clips_with_prefix(const std::string& hexadecimal) const {
  assert(!hexadecimal.empty() && hexadecimal.size() <= 16);
  std::uint64_t low = 0;
  for (const char c : hexadecimal) {
    low = low << 4 | std::string_view("0123456789abcdef").find(c);
  }
  const auto missing = 4 * (16 - static_cast<int>(hexadecimal.size()));
  low = missing < 64 ? low << missing : low;
  const std::uint64_t high = low + (missing > 0 ? (std::uint64_t{1} << missing) - 1 : 0);
  Statement row =
      impl_->prepare(std::string(clip_columns) +
                     " WHERE address BETWEEN ? AND ? ORDER BY address, take, first_frame");
  row.bind(stored_address(low)).bind(stored_address(high));
  std::vector<ClipRecord> clips;
  while (row.step()) clips.push_back(clip_row(row));
  return clips;
}

Digest ArchiveStore::content_of(std::int64_t id) const {
  const TakeRecord record = take(id);
  const std::int64_t ids[] = {id};
  const std::vector<ClipRecord> own = clips(ids);
  std::vector<Digest> layers;
  for (std::size_t i = 0; i < record.layers.size(); ++i) layers.push_back(digest_of(layer(id, i)));
  return take_content(record, proportions(record.proportions).identity,
                      digest_of_space(record.space), layers, own);
}

}  // namespace reprise
