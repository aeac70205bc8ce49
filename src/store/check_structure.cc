// Reads every page and every row.
#include <algorithm>

#include "store/key_rows.h"
#include "store/schema.h"
#include "store/store_impl.h"

namespace reprise {
namespace {

std::int64_t number(const Database& database, const std::string& sql) {
  Statement row(database, sql);
  return row.step() ? row.integer() : 0;
}

/// Pages that nothing uses are looked at too: SQLite would not read them. They are read through
/// SQLite's own descriptor, since closing another one would drop the lock of the snapshot.
void check_pages(const Database& database, std::vector<Damage>& damaged) {
  const std::int64_t pages = number(database, "PRAGMA page_count");
  Bytes page(static_cast<std::size_t>(number(database, "PRAGMA page_size")));
  for (std::int64_t p = 0; p < pages; ++p) {
    const int result = database.read_file(std::as_writable_bytes(std::span(page)),
                                          p * static_cast<std::int64_t>(page.size()));
    const bool never_used = std::ranges::all_of(page, [](std::uint8_t byte) { return byte == 0; });
    if (result == SQLITE_OK || (result == SQLITE_IOERR_DATA && never_used)) continue;
    if (result != SQLITE_IOERR_DATA) database.fail(result);
    damaged.push_back({"page " + std::to_string(p + 1), "its checksum is wrong"});
  }
}

template <class Check>
void note_damage(const std::string& id, std::vector<Damage>& damaged, Check&& check) {
  try {
    check();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::damaged) throw;
    damaged.push_back({id, error.reason()});
  }
}

}  // namespace

std::vector<Damage> ArchiveStore::check_structure() const {
  const Snapshot snapshot = this->snapshot();
  const Database& database = *impl_->database;
  std::vector<Damage> damaged;
  check_pages(database, damaged);
  note_damage("tables", damaged, [&] {
    Statement row(database, "PRAGMA integrity_check(1)");
    if (row.step() && row.text() != "ok")
      damaged.push_back({"tables", "they do not hold together"});
    Statement keys(database, "PRAGMA foreign_key_check");
    while (keys.step())
      damaged.push_back({"tables", "a row of '" + keys.text() + "' refers to one that is gone"});
  });
  note_damage("skeletons", damaged, [&] { skeletons(); });
  check_takes(damaged);
  return damaged;
}

std::vector<TakeInfo> ArchiveStore::readable_takes(std::vector<Damage>& damaged) const {
  const Snapshot snapshot = this->snapshot();
  std::vector<TakeInfo> readable;
  note_damage("takes", damaged, [&] {
    Statement ids(*impl_->database, "SELECT id FROM blocks ORDER BY id");
    while (ids.step()) {
      const std::int64_t id = ids.integer();
      note_damage("block " + std::to_string(id), damaged, [&] {
        const auto block = impl_->block(id);
        for (const StoredTake& stored : block->takes) {
          note_damage(stored.record.info.name, damaged,
                      [&] { readable.push_back(take(block->id_of(stored)).info); });
        }
      });
    }
  });
  std::ranges::sort(readable, {}, &TakeInfo::name);
  return readable;
}

void ArchiveStore::check_takes(std::vector<Damage>& damaged) const {
  const Database& database = *impl_->database;
  Digest sum{};
  bool whole = true;
  std::size_t keys = 0, terms = 0;
  const KeyRows term_rows(database, KeyTarget::block);
  const auto check_take = [&](const TakeBlock& block, const StoredTake& take) {
    const std::int64_t id = block.id_of(take);
    add_to_sum(sum, content_of(id));
    const std::int64_t ids_of_one[] = {id};
    const std::vector<ClipRecord> own = clips(ids_of_one);
    for (const std::int64_t key : keys_of(take.record.info, own)) {
      ++keys;
      const std::vector<std::int64_t> found = impl_->takes_with_keys(key, key);
      if (std::ranges::find(found, id) == found.end())
        throw Error(ErrorCode::damaged, "it is not in the index");
    }
  };
  const auto check_terms = [&](const TakeBlock& block) {
    for (const std::int64_t key : terms_of(block, WordSplitter(database))) {
      ++terms;
      const std::vector<std::int64_t> found = term_rows.find(key, key);
      if (std::ranges::find(found, block.id) == found.end())
        throw Error(ErrorCode::damaged, "it is not in the index");
    }
  };
  Statement ids(database, "SELECT id, length(data) FROM blocks ORDER BY id");
  note_damage("takes", damaged, [&] {
    while (ids.step()) {
      const std::int64_t id = ids.integer();
      const auto size = static_cast<std::size_t>(ids.integer());
      const std::size_t before = damaged.size();
      note_damage("block " + std::to_string(id), damaged, [&] {
        const auto block = impl_->block(id);
        if (size != block->data_size())
          throw Error(ErrorCode::damaged, "its motion is not as long as it should be");
        for (const StoredTake& take : block->takes)
          note_damage(take.record.info.name, damaged, [&] { check_take(*block, take); });
        check_terms(*block);
      });
      whole = whole && damaged.size() == before;
    }
    if (!whole) return;
    if (keys != KeyRows(database, KeyTarget::take).count())
      damaged.push_back({"keys", "some lead to no take"});
    if (terms != term_rows.count()) damaged.push_back({"keys", "some lead to no block"});
    Statement row(database, "SELECT value FROM meta WHERE key='content'");
    if (!row.step() || !std::ranges::equal(row.bytes(), sum))
      damaged.push_back({"takes", "they are not those that were stored"});
  });
}

}  // namespace reprise
