#include "store/writer_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "reprise/error.h"

namespace reprise {

namespace {

/// Whether the file of a descriptor is still the one of that path.
bool is_file_of(int descriptor, const std::filesystem::path& path) {
  struct stat held = {}, there = {};
  return ::fstat(descriptor, &held) == 0 && ::stat(path.c_str(), &there) == 0 &&
         held.st_dev == there.st_dev && held.st_ino == there.st_ino;
}

}  // namespace

WriterLock::WriterLock(const std::filesystem::path& path, bool created)
    : path_(path), descriptor_(::open(path.c_str(), O_RDWR | O_CLOEXEC)), created_(created) {
  if (descriptor_ < 0) {
    throw Error(code_of_errno(errno),
                std::string("the archive cannot be opened for writing: ") + std::strerror(errno),
                {path.string()});
  }
  const bool locked = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
  if (!locked || !is_file_of(descriptor_, path)) {
    const int number = locked ? EWOULDBLOCK : errno;
    ::close(descriptor_);
    if (number == EWOULDBLOCK) {
      throw Error(ErrorCode::locked, "another process is writing to the archive", {path.string()},
                  "try again when it is done");
    }
    throw Error(ErrorCode::failed,
                std::string("the archive cannot be locked for writing: ") + std::strerror(number),
                {path.string()}, "put it on a file system that has locks");
  }
}

WriterLock::~WriterLock() {
  std::error_code error;
  if (created_) std::filesystem::remove(path_, error);
  ::close(descriptor_);
}

}  // namespace reprise
