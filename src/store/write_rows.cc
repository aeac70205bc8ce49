// Rows into the archive, and out of it.
#include <cassert>

#include "store/compression.h"
#include "store/store_impl.h"

namespace reprise {
namespace {

Digest content_sum(const Database& database) {
  Statement statement(database, "SELECT value FROM meta WHERE key='content'");
  Digest sum{};
  if (statement.step()) {
    const Bytes bytes = statement.bytes();
    if (bytes.size() == sum.size()) std::copy(bytes.begin(), bytes.end(), sum.begin());
  }
  return sum;
}

void store_content_sum(const Database& database, const Digest& sum) {
  Statement(database, "UPDATE meta SET value=? WHERE key='content'").bind(sum).run();
}

std::int64_t subject_row(const Database& database, const std::string& name) {
  if (name.empty()) return 0;
  Statement known(database, "SELECT id FROM subjects WHERE name=?");
  known.bind(name);
  if (known.step()) return known.integer();
  Statement(database, "INSERT INTO subjects(name) VALUES(?)").bind(name).run();
  return database.last_row();
}

void insert_clip(const Database& database, std::int64_t take, const ClipRecord& clip) {
  Statement(
      database,
      "INSERT INTO clips(address, take, first_frame, frames, kind, family, primary_clip, bytes) "
      "VALUES(?,?,?,?,?,?,?,?)")
      .bind(stored_address(clip.id))
      .bind(take)
      .bind(std::int64_t{clip.first_frame})
      .bind(std::int64_t{clip.frames})
      .bind(std::int64_t{static_cast<int>(clip.kind)})
      .bind(clip.group)
      .bind(static_cast<std::int64_t>(clip.primary))
      .bind(static_cast<std::int64_t>(clip.bytes))
      .run();
}

}  // namespace

std::int64_t ArchiveStore::add_skeleton(const SkeletonRecord& record) {
  impl_->require_transaction();
  impl_
      ->prepare(
          "INSERT INTO skeletons(structure, format, joints, channels, root, digest) "
          "VALUES(?,?,?,?,?,?)")
      .bind(record.structure)
      .bind(std::int64_t{static_cast<int>(record.format)})
      .bind(static_cast<std::int64_t>(record.joints))
      .bind(static_cast<std::int64_t>(record.channels))
      .bind(record.root)
      .bind(row_digest(record))
      .run();
  return impl_->database->last_row();
}

std::int64_t ArchiveStore::add_proportions(const ProportionsRecord& record) {
  impl_->require_transaction();
  // What the first actor's text holds is not stored again for the others.
  std::string prefix;
  Statement first = impl_->prepare("SELECT count(*) FROM proportions WHERE skeleton=?");
  first.bind(record.skeleton);
  if (first.step() && first.integer() > 0)
    prefix = reference_proportions(record.skeleton).source_text;
  const Digest identity = proportions_identity(record);
  Bytes text = compress(bytes_of(record.source_text), true, bytes_of(prefix));
  impl_
      ->prepare(
          "INSERT INTO proportions(skeleton, identity, unit_mm, frame_rate, assumed, asf_name, "
          "layout, text, "
          "digest) VALUES(?,?,?,?,?,?,?,?,?)")
      .bind(record.skeleton)
      .bind(identity)
      .bind(record.millimetres_per_unit)
      .bind(record.frame_rate)
      .bind(std::int64_t{record.frame_rate_assumed})
      .bind(record.asf_name)
      .bind(compress(record.layout, true))
      .bind(text)
      .bind(shortened(identity))
      .run();
  return impl_->database->last_row();
}

std::int64_t ArchiveStore::add_space(const SpaceRecord& record) {
  impl_->require_transaction();
  Digest base{};
  if (record.base != 0) base = digest_of_space(record.base);
  const Digest digest = space_digest(skeleton(record.skeleton).structure, base, record.data);
  impl_->prepare("INSERT INTO spaces(skeleton, base, data, digest) VALUES(?,?,?,?)")
      .bind(record.skeleton)
      .bind(record.base)
      .bind(compress(record.data, false))
      .bind(digest)
      .run();
  return impl_->database->last_row();
}

std::int64_t ArchiveStore::add_take(const TakeRecord& take, std::span<const ClipRecord> clips) {
  impl_->require_transaction();
  const Database& database = *impl_->database;
  const TakeInfo& info = take.info;
  const auto [folder, leaf] = split_name(info.name);
  assert(!take.layers.empty() && take.layers.size() <= most_layers);
  const Bytes layers = pack_layers(layer_table(take.layers));
  Statement insert = impl_->prepare(
      "INSERT INTO takes(leaf, folder, subject, proportions, space, frames, tier, limit_mm, "
      "text_bytes, "
      "mean_um, rms_um, p99_um, max_um, sketch, spent, source, layers, digest) "
      "VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
  insert.bind(leaf).bind(folder).bind(subject_row(database, info.subject));
  insert.bind(take.proportions).bind(take.space).bind(std::int64_t{info.frames});
  insert.bind(std::int64_t{static_cast<int>(info.fidelity.tier)}).bind(info.fidelity.limit_mm);
  insert.bind(static_cast<std::int64_t>(info.text_bytes));
  insert.bind(micrometres(info.error_mm.mean)).bind(micrometres(info.error_mm.rms));
  insert.bind(micrometres(info.error_mm.p99)).bind(micrometres(info.error_mm.max));
  insert.bind(take.error_quantiles).bind(pack_spent(take.spent));
  insert.bind(from_hexadecimal(info.source_digest)).bind(layers);
  insert.bind(row_digest(take, layers)).run();
  const std::int64_t id = database.last_row();
  if (!info.description.empty() || !info.tags.empty()) {
    impl_->prepare("INSERT INTO texts(take, description, tags) VALUES(?,?,?)")
        .bind(id)
        .bind(info.description)
        .bind(info.tags)
        .run();
  }
  for (const ClipRecord& clip : clips) insert_clip(database, id, clip);
  for (std::size_t i = 0; i < take.layers.size(); ++i) {
    impl_->prepare("INSERT INTO blobs(id, data) VALUES(?,?)")
        .bind(blob_row(id, i))
        .bind(compress(take.layers[i].data, false))
        .run();
  }
  Digest sum = content_sum(database);
  add_to_sum(sum, content_of(id));
  store_content_sum(database, sum);
  return id;
}

void ArchiveStore::remove_take(std::int64_t id) {
  impl_->require_transaction();
  const Database& database = *impl_->database;
  const TakeRecord record = take(id);
  Digest sum = content_sum(database);
  subtract_from_sum(sum, content_of(id));
  store_content_sum(database, sum);
  for (const char* table : {"clips", "texts"}) {
    Statement(database, std::string("DELETE FROM ") + table + " WHERE take=?").bind(id).run();
  }
  Statement(database, "DELETE FROM blobs WHERE id BETWEEN ? AND ?")
      .bind(blob_row(id, 0))
      .bind(blob_row(id, most_layers - 1))
      .run();
  impl_->prepare("DELETE FROM takes WHERE id=?").bind(id).run();
  // What nothing refers to any more goes too; a skeleton keeps its axes and the proportions that
  // they are for.
  impl_->prepare("DELETE FROM subjects WHERE id NOT IN (SELECT subject FROM takes)").run();
  Statement left = impl_->prepare(
      "SELECT count(*) FROM takes JOIN proportions ON proportions.id=takes.proportions "
      "WHERE proportions.skeleton=?");
  left.bind(record.info.skeleton);
  left.step();
  if (left.integer() == 0) {
    impl_->prepare("DELETE FROM spaces WHERE skeleton=?").bind(record.info.skeleton).run();
    impl_->prepare("DELETE FROM proportions WHERE skeleton=?").bind(record.info.skeleton).run();
    impl_->prepare("DELETE FROM skeletons WHERE id=?").bind(record.info.skeleton).run();
    return;
  }
  impl_
      ->prepare(
          "DELETE FROM proportions WHERE id=? AND id NOT IN (SELECT proportions FROM takes) AND "
          "id<>(SELECT min(id) FROM proportions WHERE skeleton=?)")
      .bind(record.proportions)
      .bind(record.info.skeleton)
      .run();
}

}  // namespace reprise
