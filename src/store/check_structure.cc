// Reads every page and every row.
#include <algorithm>
#include <fstream>

#include "store/page_checksum_vfs.h"
#include "store/schema.h"
#include "store/store_impl.h"

namespace reprise {
namespace {

/// Pages that nothing uses are looked at too: SQLite would not read them.
void check_pages(const std::filesystem::path& path, std::size_t size,
                 std::vector<Damage>& damaged) {
  std::ifstream file(path, std::ios::binary);
  Bytes page(size);
  for (std::uint64_t number = 1;
       file.read(reinterpret_cast<char*>(page.data()), static_cast<std::streamsize>(size));
       ++number) {
    const bool never_used = std::ranges::all_of(page, [](std::uint8_t byte) { return byte == 0; });
    if (!never_used && !page_is_whole(page, number)) {
      damaged.push_back({"page " + std::to_string(number), "its checksum is wrong"});
    }
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
  const Database& database = *impl_->database;
  std::vector<Damage> damaged;
  Statement size(database, "PRAGMA page_size");
  size.step();
  check_pages(database.path(), static_cast<std::size_t>(size.integer()), damaged);
  note_damage("tables", damaged, [&] {
    Statement row(database, "PRAGMA integrity_check(20)");
    while (row.step()) {
      const std::string found = row.text();
      if (found != "ok") damaged.push_back({"tables", found});
    }
    Statement keys(database, "PRAGMA foreign_key_check");
    while (keys.step())
      damaged.push_back({"tables", "a row of '" + keys.text() + "' refers to one that is gone"});
  });
  note_damage("blobs", damaged, [&] {
    Statement row(database,
                  "SELECT id FROM blobs WHERE id/8 NOT IN (SELECT id FROM takes) LIMIT 20");
    while (row.step()) {
      damaged.push_back({"blobs", "row " + std::to_string(row.integer()) + " belongs to no take"});
    }
  });
  note_damage("skeletons", damaged, [&] { skeletons(); });
  note_damage("takes", damaged, [&] {
    Digest sum{};
    Statement ids(database, "SELECT id, folder, leaf FROM takes ORDER BY id");
    bool whole = true;
    while (ids.step()) {
      const std::int64_t id = ids.integer();
      const std::string folder = ids.text();
      const std::string name = join_name(folder, ids.text());
      const std::size_t before = damaged.size();
      note_damage(name, damaged, [&] { add_to_sum(sum, content_of(id)); });
      whole = whole && damaged.size() == before;
    }
    Statement row(database, "SELECT value FROM meta WHERE key='content'");
    if (whole && (!row.step() || !std::ranges::equal(row.bytes(), sum))) {
      damaged.push_back({"takes", "they are not those that were stored"});
    }
  });
  return damaged;
}

}  // namespace reprise
