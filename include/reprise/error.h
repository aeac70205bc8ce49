// What goes wrong through no fault of ours: one exception type that says what, where and what to
// do.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace reprise {

/// Persisted in scripts as exit codes of the command (docs/cli.md): never change a value.
enum class ErrorCode : int {
  failed = 1,
  usage = 2,
  rejected_input = 3,  ///< a motion file that cannot be taken in; the rest of a library goes on
  damaged = 4,         ///< the archive is damaged, or not an archive
  newer_version = 5,
  locked = 6,
  not_found = 7,
  limit = 9,  ///< a limit of the archive or of the machine, a full disk among them
  interrupted = 130,
};

/// What an errno of the system means: limit where a disk, a quota, the size of a file, memory or a
/// number of files or threads is at its limit, else failed.
ErrorCode code_of_errno(int number);

/// The system's words for an errno. Where there is no room for a file, they say what there is none
/// of: bytes, or further files; `path` is of that file system.
std::string reason_of_errno(int number, const std::string& path);

/// Where in a user's file an error was seen. `line` is 1-based; 0 where no line is meant.
struct SourcePlace {
  std::string file;
  std::size_t line = 0;
};

/// An error that a user can cause. `what()` is one sentence, prefixed with "file:line: " where
/// known.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& reason, SourcePlace place = {}, std::string advice = {});

  ErrorCode code() const { return code_; }
  const std::string& reason() const { return reason_; }
  const SourcePlace& place() const { return place_; }
  const std::string& advice() const { return advice_; }

 private:
  ErrorCode code_;
  std::string reason_;
  SourcePlace place_;
  std::string advice_;
};

}  // namespace reprise
