#include "store/archive_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <sstream>

#include "store/archive_store.h"
#include "store/digest.h"
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
  std::istringstream lines(schema_text());
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == ';') line.pop_back();
    expected.push_back(line);
  }
  Statement statement(database, "SELECT sql FROM sqlite_schema WHERE sql IS NOT NULL");
  while (statement.step()) found.push_back(statement.text());
  std::ranges::sort(expected);
  std::ranges::sort(found);
  if (expected != found)
    throw_damaged(database.path(), "the tables are not those of a Reprise archive");
}

/// SQLite's header of a file.
constexpr std::size_t header_bytes = 100;
constexpr std::size_t version_at = 60, application_at = 68;

/// A number of the header, high byte first.
std::int64_t header_number(std::string_view header, std::size_t at) {
  std::uint32_t value = 0;
  for (const char byte : header.substr(at, 4)) value = value << 8 | static_cast<std::uint8_t>(byte);
  return static_cast<std::int32_t>(value);
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

/// A file of its own beside an archive, which goes with this object.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& beside)
      : path_(beside.string() + ".new-" + std::to_string(::getpid())) {
    ::unlink(path_.c_str());
    const int descriptor = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0) {
      throw Error(code_of_errno(errno),
                  std::string("the archive cannot be opened for writing: ") + std::strerror(errno),
                  {beside.string()});
    }
    ::close(descriptor);
  }
  ~TemporaryFile() { ::unlink(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

bool is_empty_file(const fs::path& path) {
  return fs::is_regular_file(path) && fs::file_size(path) == 0;
}

}  // namespace

bool begins_as_archive(std::string_view start) {
  constexpr std::string_view magic("SQLite format 3\0", 16);
  return start.size() >= header_bytes && start.starts_with(magic) &&
         header_number(start, application_at) == application_id;
}

void check_header(const Database& database) {
  const fs::path& path = database.path();
  std::array<char, header_bytes> bytes{};
  const int read = database.read_file(std::as_writable_bytes(std::span(bytes)), 0);
  if (read != SQLITE_OK && read != SQLITE_IOERR_SHORT_READ) database.fail(read);
  const std::string_view header(bytes.data(), bytes.size());
  if (!begins_as_archive(header)) throw_damaged(path, "this is not a Reprise archive");
  const std::int64_t version = header_number(header, version_at);
  if (version / 1000 > format_version / 1000) {
    throw Error(ErrorCode::newer_version,
                "the archive has format " + std::to_string(version / 1000) +
                    "; this program reads format " + std::to_string(format_version / 1000),
                {path.string()}, "a newer version of the program reads it");
  }
}

void check_identity(Database& database) {
  const fs::path& path = database.path();
  check_header(database);
  database.run("BEGIN");
  Statement(database, "SELECT count(*) FROM sqlite_schema").step();
  const auto size = static_cast<std::int64_t>(fs::file_size(path));
  if (size != pragma(database, "page_count") * pragma(database, "page_size")) {
    throw_damaged(path, "the archive is damaged: the file is " + std::to_string(size) +
                            " bytes long, which is not what it says");
  }
  check_schema(database);
  database.run("COMMIT");
}

bool create_if_missing(const fs::path& path) {
  const bool there = fs::exists(path);
  if (there && !is_empty_file(path)) return false;
  // Of several processes that find an empty file one alone puts an archive in its place.
  std::optional<WriterLock> lock;
  if (there) lock.emplace(path, false);
  if (there && !is_empty_file(path)) return false;
  const TemporaryFile whole(path);
  try {
    create_archive(whole.path());
  } catch (const Error& error) {  // told of the file that is meant
    throw Error(error.code(), error.reason(), {path.string()}, error.advice());
  }
  // Another writer may have come first; a link, where there are links, does not replace its file.
  if (!there && ::link(whole.path().c_str(), path.c_str()) == 0) return true;
  if (!there && errno == EEXIST) return false;
  // What was there before is not taken away again.
  return ::rename(whole.path().c_str(), path.c_str()) == 0 && !there;
}

std::int64_t pragma(const Database& database, const std::string& name) {
  Statement statement(database, "PRAGMA " + name);
  return statement.step() ? statement.integer() : 0;
}

}  // namespace reprise
