#include "model/new_file.h"

#include <fcntl.h>
#include <stdio.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <vector>

#include "reprise/error.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t digits_of_name = 16;
constexpr std::string_view hexadecimal_digits = "0123456789abcdef";
constexpr std::string_view journal_end = "-journal";

constexpr std::string_view before_digits = ".new-";

fs::path unforetold_name(const fs::path& target) {
  std::array<unsigned char, digits_of_name / 2> random{};
  if (::getrandom(random.data(), random.size(), 0) != static_cast<ssize_t>(random.size())) {
    throw Error(ErrorCode::failed, "the system gives no random numbers");
  }
  std::string name = target.filename().string();
  name += before_digits;
  for (const unsigned char byte : random) {
    name += hexadecimal_digits[byte >> 4];
    name += hexadecimal_digits[byte & 15];
  }
  return target.parent_path() / name;
}

/// Whether a name is one of ours for a target (empty: for any), or that of the journal beside one.
bool is_name_of_ours(std::string_view name, std::string_view target) {
  if (name.ends_with(journal_end)) name.remove_suffix(journal_end.size());
  const std::size_t tail = before_digits.size() + digits_of_name;
  if (name.size() <= tail) return false;
  const std::string_view end = name.substr(name.size() - tail);
  name.remove_suffix(tail);
  return (target.empty() || name == target) && end.starts_with(before_digits) &&
         end.substr(before_digits.size()).find_first_not_of(hexadecimal_digits) ==
             std::string_view::npos;
}

/// Removes the file unless the process that makes it lives.
void remove_if_dead(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  struct stat status = {};
  if (::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
      ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && is_file_of(descriptor, path)) {
    ::unlink(path.c_str());
  }
  ::close(descriptor);
}

}  // namespace

bool is_file_of(int descriptor, const fs::path& path) {
  struct stat held = {}, there = {};
  return ::fstat(descriptor, &held) == 0 && ::stat(path.c_str(), &there) == 0 &&
         held.st_dev == there.st_dev && held.st_ino == there.st_ino;
}

NewFile::NewFile(const fs::path& target, std::string_view what) : target_(target), what_(what) {
  for (;;) {
    path_ = unforetold_name(target);
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno == EEXIST) continue;
    if (descriptor_ < 0) fail(errno);
    // Who looks for what dead processes have left may have come between. A file system without
    // locks has nobody who takes it away, either.
    const bool taken = ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!taken && is_file_of(descriptor_, path_)) return;
    ::close(descriptor_);
  }
}

NewFile::~NewFile() {
  if (!named_) ::unlink(path_.c_str());
  ::close(descriptor_);
}

void NewFile::fail(int number) const {
  throw Error(code_of_errno(number), what_ + ": " + reason_of_errno(number, target_.string()),
              {target_.string()});
}

void NewFile::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor_, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void NewFile::replace() {
  if (::rename(path_.c_str(), target_.c_str()) != 0) fail(errno);
  named_ = true;
}

bool NewFile::place() {
  if (::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) == 0) {
    named_ = true;
    return true;
  }
  if (errno == EEXIST) return false;
  // Some file systems cannot do this in one step.
  if (errno != EINVAL && errno != ENOSYS) fail(errno);
  if (::link(path_.c_str(), target_.c_str()) == 0) return true;  // the other name goes with this
  if (errno == EEXIST) return false;
  if (errno != EPERM && errno != EOPNOTSUPP && errno != ENOSYS) fail(errno);
  struct stat status = {};
  if (::lstat(target_.c_str(), &status) == 0) return false;
  replace();
  return true;
}

void remove_dead_new_files(const fs::path& folder, std::string_view target) {
  std::vector<fs::path> journals;
  std::error_code error;
  fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!is_name_of_ours(name, target)) continue;
    if (name.ends_with(journal_end)) {
      journals.push_back(entry->path());
    } else {
      remove_if_dead(entry->path());
    }
  }
  for (const fs::path& journal : journals) {
    const std::string name = journal.string();
    const fs::path file = name.substr(0, name.size() - journal_end.size());
    if (!fs::exists(fs::symlink_status(file, error))) ::unlink(journal.c_str());
  }
}

void sync_folder_of(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // A folder that may be written, but not read, is synced with the files in it, or not at all.
  if (descriptor < 0) return;
  const int number = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (number == 0 || number == EINVAL || number == EROFS || number == ENOTSUP) return;
  throw Error(
      code_of_errno(number),
      "the folder of the file cannot be synced: " + reason_of_errno(number, folder.string()),
      {file.string()});
}

}  // namespace reprise
