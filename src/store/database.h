// SQLite with destructors: a connection, and statements on it. Errors are Error values of the right
// kind.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "reprise/error.h"
#include "store/archive_store.h"

namespace reprise {

/// How long is waited for other processes (ms): a reader for a commit; a writer, which our own
/// writers have let in before, for whoever else has locked the file; and a commit for readers, of
/// which the user is told after a while.
struct LockWaits {
  static constexpr int reader_ms = 60000, writer_ms = 2000, commit_ms = 60000, told_ms = 1000;
};

class Database {
 public:
  enum class Mode { read, write };
  Database(const std::filesystem::path& path, Mode mode);

  void wait_for_locks(int milliseconds);
  /// Runs a statement that needs the file for itself: waits until nobody reads it, and calls
  /// `waiting` where that takes longer. Throws Error: locked, or interrupted where `waiting` says
  /// false.
  void run_alone(const std::string& sql, const std::function<bool()>& waiting);
  /// Runs statements that return nothing of interest.
  void run(const std::string& sql);
  std::int64_t last_row() const { return sqlite3_last_insert_rowid(handle_.get()); }
  sqlite3* handle() const { return handle_.get(); }
  const std::filesystem::path& path() const { return path_; }

  /// Reads the file as it is, without SQLite's cache, and returns SQLite's code: a page whose
  /// checksum is wrong is SQLITE_IOERR_DATA.
  int read_file(std::span<std::byte> to, std::int64_t offset) const;

  /// Bytes of the file. Throws Error.
  std::int64_t file_size() const;
  /// Cuts the file off, and syncs it. For who has locked it for itself. Throws Error.
  void shorten_file(std::int64_t size) const;

  /// Turns a result code into an Error.
  [[noreturn]] void fail(int code) const;

 private:
  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
  };
  sqlite3_file* file() const;

  std::filesystem::path path_;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// One statement; parameters are bound in order, columns read in order.
class Statement {
 public:
  Statement(const Database& database, std::string_view sql);

  Statement& bind(std::int64_t value);
  Statement& bind(double value);
  Statement& bind(std::string_view text);
  Statement& bind(std::span<const std::uint8_t> bytes);

  /// True if there is a row.
  bool step();
  /// For statements without rows.
  void run() { step(); }

  std::int64_t integer();
  double real();
  std::string text();
  Bytes bytes();

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  void check(int code) const;
  /// SQLite gives no text or bytes where there are none, and where it has no memory for them.
  void check_memory() const;

  const Database& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  int parameter_ = 0;
  int column_ = 0;
};

/// Where a blob is: a column of the row with an id.
struct BlobPlace {
  const char* table;
  const char* column;
  std::int64_t row;
};
/// A part of a blob, read without the rest. Throws Error (damaged) where the blob is shorter or the
/// row is not there.
Bytes read_part(const Database& database, const BlobPlace& place, std::size_t offset,
                std::size_t size);

}  // namespace reprise
