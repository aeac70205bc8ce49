#include "reprise/error.h"

#include <sys/statvfs.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace reprise {
namespace {

std::string sentence(const std::string& reason, const SourcePlace& place,
                     const std::string& advice) {
  std::string text;
  if (!place.file.empty()) text += place.file + ":";
  if (place.line > 0) text += std::to_string(place.line) + ":";
  if (!text.empty()) text += " ";
  text += reason;
  if (!advice.empty()) text += "; " + advice;
  return text;
}

}  // namespace

ErrorCode code_of_errno(int number) {
  switch (number) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
    case ENOMEM:
    case EAGAIN:  // of threads and processes
      return ErrorCode::limit;
    default:
      return ErrorCode::failed;
  }
}

std::string reason_of_errno(int number, const std::string& path) {
  struct statvfs room = {};
  if (number == ENOSPC) {
    // The file itself may not be there: its folder is on the same file system.
    const std::size_t slash = path.rfind('/');
    const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
    const bool known = ::statvfs(path.c_str(), &room) == 0 || ::statvfs(folder.c_str(), &room) == 0;
    if (known && room.f_files > 0 && room.f_favail == 0 && room.f_bavail > 0) {
      return "the file system has room for no further file (no inodes are left)";
    }
    return "the disk is full";
  }
  return std::generic_category().message(number);
}

Error::Error(ErrorCode code, const std::string& reason, SourcePlace place, std::string advice)
    : std::runtime_error(sentence(reason, place, advice)),
      code_(code),
      reason_(reason),
      place_(std::move(place)),
      advice_(std::move(advice)) {}

}  // namespace reprise
