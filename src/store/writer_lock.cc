#include "store/writer_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "model/new_file.h"
#include "reprise/error.h"

namespace reprise {

WriterLock::WriterLock(const std::filesystem::path& path, bool created)
    : path_(path), descriptor_(::open(path.c_str(), O_RDWR | O_CLOEXEC)), created_(created) {
  if (descriptor_ < 0) {
    const int number = errno;
    throw Error(
        code_of_errno(number),
        "the archive cannot be opened for writing: " + reason_of_errno(number, path.string()),
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
    throw Error(
        ErrorCode::failed,
        "the archive cannot be locked for writing: " + reason_of_errno(number, path.string()),
        {path.string()}, "put it on a file system that has locks");
  }
}

WriterLock::~WriterLock() {
  std::error_code error;
  if (created_) std::filesystem::remove(path_, error);
  ::close(descriptor_);
}

}  // namespace reprise
