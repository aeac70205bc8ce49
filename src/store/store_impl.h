// What the parts of ArchiveStore share.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "store/archive_store.h"
#include "store/database.h"
#include "store/digest.h"
#include "store/packed_columns.h"

namespace reprise {

/// The archive file held for writing by this process. SQLite's own locks are of another kind
/// (POSIX), so both can be on one file; this one must be let go after SQLite has closed, since
/// closing any descriptor of a file drops the POSIX locks on it.
class WriterLock {
 public:
  /// Makes the file if it is not there. Throws Error (locked, failed).
  explicit WriterLock(const std::filesystem::path& path);
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

struct ArchiveStore::Impl {
  std::optional<WriterLock> lock;  // let go last
  std::optional<Database> database;
  bool writing = false;
  bool in_transaction = false;
  bool broken = false;  ///< a commit failed: nothing more is written

  Statement prepare(std::string_view sql) const { return Statement(*database, sql); }
  void require_transaction() const;
};

/// "a/b/c" as folder "a/b" and leaf "c".
std::pair<std::string, std::string> split_name(const std::string& name);
std::string join_name(const std::string& folder, const std::string& leaf);

/// The row of a layer in the table of blobs.
std::int64_t blob_row(std::int64_t take, std::size_t layer);

/// Clip addresses are unsigned, SQLite's integers signed: moved so that their order stays.
std::int64_t stored_address(std::uint64_t address);
std::uint64_t address_of(std::int64_t stored);

/// Digests of rows (docs/format.md).
ShortDigest row_digest(const SkeletonRecord& record);
Digest proportions_identity(const ProportionsRecord& record);
Digest space_digest(const Digest& structure, const Digest& base, const Bytes& data);
ShortDigest row_digest(const TakeRecord& record, const Bytes& layers);
/// What a take is, wherever it stands in an archive; `layers` are the digests of its layers' data.
Digest take_content(const TakeRecord& record, const Digest& proportions, const Digest& space,
                    std::span<const Digest> layers, std::span<const ClipRecord> clips);

}  // namespace reprise
