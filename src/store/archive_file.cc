#include "store/archive_file.h"

#include <algorithm>
#include <array>
#include <optional>

#include "model/new_file.h"
#include "store/archive_store.h"
#include "store/digest.h"
#include "store/file_header.h"
#include "store/page_checksum_vfs.h"
#include "store/schema.h"
#include "store/writer_lock.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_damaged(const fs::path& path, const std::string& why) {
  throw Error(ErrorCode::damaged, why, {path.string()});
}

/// The tables must be exactly those of the schema: nothing in the file is to run code of its own.
void check_schema(const Database& database) {
  std::vector<std::string> expected, found;
  // No stream: it would take a want of memory for the end of the text.
  std::string_view text = schema_text();
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ends_with(';')) line.remove_suffix(1);
    expected.emplace_back(line);
  }
  Statement statement(database, "SELECT sql FROM sqlite_schema WHERE sql IS NOT NULL");
  while (statement.step()) found.push_back(statement.text());
  std::ranges::sort(expected);
  std::ranges::sort(found);
  if (expected != found)
    throw_damaged(database.path(), "the tables are not those of a Reprise archive");
}

/// An archive without takes.
void create_archive(const fs::path& path) {
  Database database(path, Database::Mode::write);
  // The page layout must be set before the first transaction writes a page.
  int reserved = page_checksum_bytes;
  database.run("PRAGMA auto_vacuum=NONE; PRAGMA page_size=" + std::to_string(page_size));
  sqlite3_file_control(database.handle(), "main", SQLITE_FCNTL_RESERVE_BYTES, &reserved);
  database.run("PRAGMA application_id=" + std::to_string(application_id) +
               "; PRAGMA user_version=" + std::to_string(format_version) + "; BEGIN");
  database.run(schema_text());
  Statement(database, "INSERT INTO meta(key, value) VALUES('content', ?)").bind(Digest{}).run();
  Statement(database, "INSERT INTO meta(key, value) VALUES('written_by', ?)")
      .bind(std::string_view("reprise " REPRISE_VERSION))
      .run();
  database.run("COMMIT");
}

/// Pages behind the last one that the archive needs were pages of it, or of the image that replaced
/// it, and none is there in part. The last one was written: SQLite makes a file longer by writing
/// its last page.
bool is_rest_of_archive(const Database& database, std::int64_t pages, std::int64_t page_size) {
  if (database.file_size() % page_size != 0) return false;
  const std::int64_t all = database.file_size() / page_size;
  std::vector<std::byte> page(static_cast<std::size_t>(page_size));
  for (std::int64_t p = pages; p < all; ++p) {
    const int result = database.read_file(page, p * page_size);
    if (result == SQLITE_OK) continue;
    if (result != SQLITE_IOERR_DATA) database.fail(result);
    const bool never_used =
        std::ranges::all_of(page, [](std::byte byte) { return byte == std::byte{0}; });
    if (!never_used || p + 1 == all) return false;
  }
  return true;
}

bool is_empty_file(const fs::path& path) {
  return fs::is_regular_file(path) && fs::file_size(path) == 0;
}

}  // namespace

bool begins_as_archive(std::string_view start) {
  if (start.size() < FileHeader::bytes) return false;
  const FileHeader header =
      FileHeader::read({reinterpret_cast<const std::uint8_t*>(start.data()), FileHeader::bytes});
  return header.is_database && header.application == application_id;
}

void check_header(const Database& database) {
  const fs::path& path = database.path();
  std::array<std::uint8_t, FileHeader::bytes> bytes{};
  const int read = database.read_file(std::as_writable_bytes(std::span(bytes)), 0);
  if (read != SQLITE_OK && read != SQLITE_IOERR_SHORT_READ) database.fail(read);
  const FileHeader header = FileHeader::read(bytes);
  if (!header.is_database || header.application != application_id)
    throw_damaged(path, "this is not a Reprise archive");
  if (header.version / 1000 > format_version / 1000) {
    throw Error(ErrorCode::newer_version,
                "the archive has format " + std::to_string(header.version / 1000) +
                    "; this program reads format " + std::to_string(format_version / 1000),
                {path.string()}, "a newer version of the program reads it");
  }
  if (header.write_ahead) {
    throw Error(ErrorCode::damaged,
                "another program has put the archive into SQLite's WAL mode, in which it is no "
                "Reprise archive",
                {path.string()}, "use a copy that no other program has written to");
  }
}

bool is_longer_than_it_says(const Database& database) {
  return database.file_size() > pragma(database, "page_count") * pragma(database, "page_size");
}

void check_identity(Database& database) {
  const fs::path& path = database.path();
  check_header(database);
  database.run("BEGIN");
  Statement(database, "SELECT count(*) FROM sqlite_schema").step();
  const std::int64_t size = database.file_size();
  const std::int64_t pages = pragma(database, "page_count"), bytes = pragma(database, "page_size");
  if (size < pages * bytes ||
      (size > pages * bytes && !is_rest_of_archive(database, pages, bytes))) {
    throw_damaged(path, "the archive is damaged: the file is " + std::to_string(size) +
                            " bytes long, which is not what it says");
  }
  check_schema(database);
  database.run("COMMIT");
}

void cut_off_rest(Database& database, const std::function<bool()>& waiting) {
  database.run_alone("BEGIN EXCLUSIVE", waiting);
  try {
    database.shorten_file(pragma(database, "page_count") * pragma(database, "page_size"));
  } catch (...) {
    database.run("ROLLBACK");
    throw;
  }
  database.run("ROLLBACK");
}

bool create_if_missing(const fs::path& path) {
  const bool there = fs::exists(path);
  if (there && !is_empty_file(path)) return false;
  // Of several processes that find an empty file one alone puts an archive in its place.
  std::optional<WriterLock> lock;
  if (there) lock.emplace(path, false);
  if (there && !is_empty_file(path)) return false;
  bool created = false;
  {
    NewFile whole(path, "the archive cannot be made");
    try {
      create_archive(whole.path());
    } catch (const Error& error) {  // told of the file that is meant
      throw Error(error.code(), error.reason(), {path.string()}, error.advice());
    }
    // Another writer may have come first. What was there before is not taken away again.
    if (there) {
      whole.replace();
    } else {
      created = whole.place();
    }
  }
  if (created || there) sync_folder_of(path);
  return created;
}

std::int64_t pragma(const Database& database, const std::string& name) {
  Statement statement(database, "PRAGMA " + name);
  return statement.step() ? statement.integer() : 0;
}

}  // namespace reprise
