// One process at a time writes to an archive.
#pragma once

#include <filesystem>

namespace reprise {

/// The archive file held for writing by this process. SQLite's own locks are of another kind
/// (POSIX), so both can be on one file; this one must be let go after SQLite has closed, since
/// closing any descriptor of a file drops the POSIX locks on it.
class WriterLock {
 public:
  /// Throws Error (locked, also where another process has just put another file there; failed).
  /// Where this process has `created` the file, it goes with the
  /// lock unless keep() was called: an archive that nothing was stored in is no archive.
  WriterLock(const std::filesystem::path& path, bool created);
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;
  void keep() { created_ = false; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  bool created_ = false;
};

}  // namespace reprise
