#include "store/database.h"

#include <cerrno>
#include <new>

#include "store/page_checksum_vfs.h"

namespace reprise {
namespace {

/// No row of ours is larger (bytes): what a hostile file may make SQLite allocate.
constexpr int most_row_bytes = 1 << 30;

/// What the system said of a file that could not be opened, read or written tells a limit from
/// other failures. `number` is its errno, or 0.
ErrorCode code_of(int result, int number) {
  switch (result & 0xff) {
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
    case SQLITE_FORMAT:
      return ErrorCode::damaged;
    case SQLITE_FULL:
    case SQLITE_NOMEM:
    case SQLITE_TOOBIG:
      return ErrorCode::limit;
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return ErrorCode::locked;
    case SQLITE_CANTOPEN:
      return code_of_errno(number);
    case SQLITE_IOERR:
      if (result == SQLITE_IOERR_NOMEM) return ErrorCode::limit;
      if (result == SQLITE_IOERR_DATA || result == SQLITE_IOERR_SHORT_READ ||
          result == SQLITE_IOERR_CORRUPTFS || result == foreign_journal) {
        return ErrorCode::damaged;
      }
      // EAGAIN is of locks here.
      return number == EAGAIN ? ErrorCode::failed : code_of_errno(number);
    default:
      return ErrorCode::failed;
  }
}

std::string reason_of(int result, int number, const std::string& path, const std::string& journal) {
  const std::string system = number != 0 ? ": " + reason_of_errno(number, path) : std::string();
  switch (result & 0xff) {
    case SQLITE_NOTADB:
      return "this is not a Reprise archive";
    case SQLITE_CORRUPT:
    case SQLITE_FORMAT:
      return "the archive is damaged: its tables do not hold together";
    case SQLITE_FULL: {
      const std::string full = reason_of_errno(ENOSPC, path);
      return full == reason_of_errno(ENOSPC, {})
                 ? full + ", or a limit on the size of files is reached"
                 : full;
    }
    case SQLITE_NOMEM:
    case SQLITE_TOOBIG:
      return "out of memory";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "the archive is in use by another process";
    case SQLITE_READONLY:
      return result == SQLITE_READONLY_DIRECTORY
                 ? "the folder of the archive cannot be written; a change is kept in a file beside "
                   "it until it is complete"
                 : "a writer that ended left a change unfinished, which can be taken back only "
                   "where the archive may be written";
    case SQLITE_CANTOPEN:
      return "the archive, or the file beside it that keeps a change until it is complete, cannot "
             "be "
             "opened" +
             system;
    case SQLITE_PERM:
    case SQLITE_AUTH:
      return "the archive may not be opened" + system;
    case SQLITE_IOERR:
      if (result == SQLITE_IOERR_NOMEM) return "out of memory";
      if (result == SQLITE_IOERR_DATA)
        return "the archive is damaged: a page is not as it was written";
      if (result == SQLITE_IOERR_SHORT_READ || result == SQLITE_IOERR_CORRUPTFS)
        return "the archive is damaged: a part of the file is not there";
      if (result == foreign_journal) {
        return "the file '" + journal +
               "' is what a writer left of a change to another archive, or to another state of "
               "this "
               "one; taken back here it would destroy this one";
      }
      return "the archive cannot be read or written" + system;
    default:
      return "the archive cannot be used (SQLite's error " + std::to_string(result) + ")";
  }
}

std::string advice_of(int result) {
  if (result != foreign_journal) return {};
  return "put the archive back that the file belongs to; or, if this is the archive that you mean, "
         "move the file away";
}

}  // namespace

Database::Database(const std::filesystem::path& path, Mode mode) : path_(path) {
  sqlite3* raw = nullptr;
  const int flags = mode == Mode::read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE;
  // SQLite takes the names :memory: and file:... for something else than files.
  const std::filesystem::path file = path.is_absolute() ? path : "." / path;
  const int result = sqlite3_open_v2(
      file.c_str(), &raw, flags | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE, page_checksum_vfs());
  handle_.reset(raw);
  if (result != SQLITE_OK) fail(result);
  wait_for_locks(mode == Mode::read ? LockWaits::reader_ms : LockWaits::writer_ms);
  // What SQLite's own documentation advises for files from anywhere.
  sqlite3_db_config(raw, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(raw, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_limit(raw, SQLITE_LIMIT_LENGTH, most_row_bytes);
  run("PRAGMA cell_size_check=ON; PRAGMA mmap_size=0; PRAGMA foreign_keys=ON; PRAGMA "
      "temp_store=MEMORY;");
}

void Database::wait_for_locks(int milliseconds) {
  sqlite3_busy_timeout(handle_.get(), milliseconds);
}

void Database::run(const std::string& sql) {
  const int result = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (result != SQLITE_OK) fail(result);
}

void Database::run_alone(const std::string& sql, const std::function<bool()>& waiting) {
  const auto attempt = [&](int milliseconds) {
    wait_for_locks(milliseconds);
    const int result = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
    wait_for_locks(LockWaits::writer_ms);
    return result;
  };
  int result = attempt(LockWaits::told_ms);
  for (int waited = LockWaits::told_ms;
       code_of(result, 0) == ErrorCode::locked && waited < LockWaits::commit_ms;
       waited += LockWaits::told_ms) {
    if (waiting && !waiting()) {
      throw Error(ErrorCode::interrupted, "stopped while other processes read the archive");
    }
    result = attempt(LockWaits::told_ms);
  }
  if (result != SQLITE_OK) fail(result);
}

sqlite3_file* Database::file() const {
  sqlite3_file* file = nullptr;
  sqlite3_file_control(handle_.get(), "main", SQLITE_FCNTL_FILE_POINTER, &file);
  return file;
}

int Database::read_file(std::span<std::byte> to, std::int64_t offset) const {
  return file()->pMethods->xRead(file(), to.data(), static_cast<int>(to.size()), offset);
}

std::int64_t Database::file_size() const {
  sqlite3_int64 size = 0;
  const int result = file()->pMethods->xFileSize(file(), &size);
  if (result != SQLITE_OK) fail(result);
  return size;
}

void Database::shorten_file(std::int64_t size) const {
  int result = file()->pMethods->xTruncate(file(), size);
  if (result == SQLITE_OK) result = file()->pMethods->xSync(file(), SQLITE_SYNC_FULL);
  if (result != SQLITE_OK) fail(result);
}

void Database::fail(int code) const {
  if (!handle_) throw std::bad_alloc();
  int number = sqlite3_system_errno(handle_.get());
  // A call to the file itself does not pass through SQLite's own record of errors.
  if (number == 0 && (code & 0xff) == SQLITE_IOERR && file() != nullptr) {
    file()->pMethods->xFileControl(file(), SQLITE_FCNTL_LAST_ERRNO, &number);
  }
  const char* name = sqlite3_db_filename(handle_.get(), "main");
  const std::string journal = name != nullptr ? sqlite3_filename_journal(name) : std::string();
  throw Error(code_of(code, number), reason_of(code, number, path_.string(), journal),
              {path_.string()}, advice_of(code));
}

Statement::Statement(const Database& database, std::string_view sql) : database_(database) {
  sqlite3_stmt* raw = nullptr;
  check(sqlite3_prepare_v2(database.handle(), sql.data(), static_cast<int>(sql.size()), &raw,
                           nullptr));
  statement_.reset(raw);
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) database_.fail(code);
}

Statement& Statement::bind(std::int64_t value) {
  check(sqlite3_bind_int64(statement_.get(), ++parameter_, value));
  return *this;
}

Statement& Statement::bind(double value) {
  check(sqlite3_bind_double(statement_.get(), ++parameter_, value));
  return *this;
}

Statement& Statement::bind(std::string_view text) {
  check(sqlite3_bind_text64(statement_.get(), ++parameter_, text.data() ? text.data() : "",
                            text.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
  return *this;
}

Statement& Statement::bind(std::span<const std::uint8_t> bytes) {
  check(bytes.empty() ? sqlite3_bind_zeroblob(statement_.get(), ++parameter_, 0)
                      : sqlite3_bind_blob64(statement_.get(), ++parameter_, bytes.data(),
                                            bytes.size(), SQLITE_TRANSIENT));
  return *this;
}

bool Statement::step() {
  column_ = 0;
  const int result = sqlite3_step(statement_.get());
  if (result == SQLITE_ROW) return true;
  if (result != SQLITE_DONE) database_.fail(result);
  return false;
}

std::int64_t Statement::integer() { return sqlite3_column_int64(statement_.get(), column_++); }

double Statement::real() { return sqlite3_column_double(statement_.get(), column_++); }

void Statement::check_memory() const {
  if ((sqlite3_errcode(database_.handle()) & 0xff) == SQLITE_NOMEM) database_.fail(SQLITE_NOMEM);
}

std::string Statement::text() {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column_));
  const int size = sqlite3_column_bytes(statement_.get(), column_++);
  if (text != nullptr) return {text, static_cast<std::size_t>(size)};
  check_memory();
  return {};
}

Bytes Statement::bytes() {
  const auto* data =
      static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_.get(), column_));
  const int size = sqlite3_column_bytes(statement_.get(), column_++);
  if (data != nullptr) return {data, data + size};
  check_memory();
  return {};
}

Bytes read_part(const Database& database, const BlobPlace& place, std::size_t offset,
                std::size_t size) {
  struct Close {
    void operator()(sqlite3_blob* blob) const { sqlite3_blob_close(blob); }
  };
  sqlite3_blob* raw = nullptr;
  const int result =
      sqlite3_blob_open(database.handle(), "main", place.table, place.column, place.row, 0, &raw);
  const std::unique_ptr<sqlite3_blob, Close> blob(raw);
  if (result != SQLITE_OK && result != SQLITE_ERROR) database.fail(result);
  const auto available =
      result == SQLITE_OK ? static_cast<std::size_t>(sqlite3_blob_bytes(raw)) : 0;
  // SQLITE_ERROR says that there is no such row, or no blob in it.
  if (result == SQLITE_ERROR || offset > available || size > available - offset) {
    throw Error(ErrorCode::damaged,
                "the archive is damaged: a part of a row of '" + std::string(place.table) +
                    "' is not there",
                {database.path().string()});
  }
  Bytes bytes(size);
  const int read =
      sqlite3_blob_read(raw, bytes.data(), static_cast<int>(size), static_cast<int>(offset));
  if (read != SQLITE_OK) database.fail(read);
  return bytes;
}

}  // namespace reprise
