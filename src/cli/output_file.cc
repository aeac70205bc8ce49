#include "cli/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

/// Whether an errno is about one name, rather than about the disk or the folder.
bool is_of_one_name(int number) {
  switch (number) {
    case ENAMETOOLONG:
    case ENOTDIR:
    case EISDIR:
    case ELOOP:
    case EEXIST:
    case EINVAL:
    case EILSEQ:
      return true;
    default:
      return false;
  }
}

[[noreturn]] void fail(const fs::path& path, std::string_view what, int number) {
  const std::string reason =
      fmt::format("{}: {}", what, reason_of_errno(number, path.parent_path().string() + "/"));
  if (is_of_one_name(number)) throw FileError(ErrorCode::failed, reason, {path.string(), 0});
  throw Error(code_of_errno(number), reason, {path.string(), 0});
}

[[noreturn]] void refuse_special(const fs::path& path) {
  throw FileError(ErrorCode::failed, "this is not a regular file, and is not replaced",
                  {path.string(), 0}, "-o - writes to stdout");
}

/// A name that nobody can foretell.
std::string temporary_name() {
  std::array<unsigned char, 8> random{};
  if (getrandom(random.data(), random.size(), 0) != static_cast<ssize_t>(random.size())) {
    throw Error(ErrorCode::failed, "the system gives no random numbers");
  }
  std::string name = ".reprise-";
  for (const unsigned char byte : random) name += fmt::format("{:02x}", byte);
  return name;
}

/// A new file in the folder of the one meant. It is gone when this ends, unless it was renamed.
class TemporaryFile {
 public:
  TemporaryFile(int folder, std::string target, fs::path path)
      : folder_(folder), target_(std::move(target)), path_(std::move(path)) {
    do {
      name_ = temporary_name();
      descriptor_ = openat(folder_, name_.c_str(),
                           O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ < 0) fail(path_, "the file cannot be created", errno);
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!renamed_) unlinkat(folder_, name_.c_str(), 0);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::string_view content) {
    while (!content.empty()) {
      const ssize_t written = ::write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(path_, "the file cannot be written", errno);
      content.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void finish(bool overwrite) {
    if (fsync(descriptor_) != 0) fail(path_, "the file cannot be written", errno);
    const int closed = close(std::exchange(descriptor_, -1));
    if (closed != 0) fail(path_, "the file cannot be written", errno);
    rename_to_target(overwrite);
    renamed_ = true;
  }

 private:
  void rename_to_target(bool overwrite) {
    if (!overwrite) {
      const int result =
          renameat2(folder_, name_.c_str(), folder_, target_.c_str(), RENAME_NOREPLACE);
      if (result == 0) return;
      if (errno == EEXIST) refuse_existing(path_);
      // Some file systems cannot do this in one step.
      if (errno != EINVAL && errno != ENOSYS) fail(path_, "the file cannot be renamed", errno);
      struct stat status = {};
      if (fstatat(folder_, target_.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0) {
        refuse_existing(path_);
      }
    }
    if (renameat(folder_, name_.c_str(), folder_, target_.c_str()) != 0) {
      fail(path_, "the file cannot be renamed", errno);
    }
  }

  int folder_;
  std::string target_;
  fs::path path_;  ///< for what is told
  std::string name_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

/// To lead to what is in it: it need not be readable for that.
constexpr int as_folder = O_PATH | O_DIRECTORY | O_CLOEXEC;

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

int open_folder(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), as_folder);
  if (descriptor < 0) fail(folder, "the folder cannot be opened", errno);
  return descriptor;
}

/// The folder `name` in another one, made where it is not there.
int open_folder_in(int parent, const std::string& name, const fs::path& path) {
  if (mkdirat(parent, name.c_str(), 0777) != 0 && errno != EEXIST) {
    fail(path, "the folder cannot be made", errno);
  }
  const int descriptor = openat(parent, name.c_str(), as_folder | O_NOFOLLOW);
  if (descriptor >= 0) return descriptor;
  const int number = errno;
  struct stat status = {};
  if (fstatat(parent, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(status.st_mode)) {
    throw FileError(
        ErrorCode::failed,
        "a symbolic link stands where a folder of the output belongs; it is not followed",
        {path.string(), 0});
  }
  fail(path, "the folder cannot be made", number);
}

}  // namespace

fs::path path_inside(const fs::path& folder, std::string_view name) {
  const auto refuse = [&] {
    throw Error(ErrorCode::damaged,
                "the archive holds a name that does not lead into the folder of the output: \"" +
                    std::string(name) + "\"");
  };
  if (name.empty() || name.find('\0') != std::string_view::npos) refuse();
  std::string_view rest = name;
  while (true) {
    const auto slash = rest.find('/');
    const auto component = rest.substr(0, slash);
    if (component.empty() || component == "." || component == "..") refuse();
    if (slash == std::string_view::npos) break;
    rest.remove_prefix(slash + 1);
  }
  return folder / fs::path(name);
}

OutputFolder OutputFolder::of(const fs::path& file) {
  const fs::path folder = folder_of(file);
  return {folder, open_folder(folder)};
}

OutputFolder OutputFolder::below(const fs::path& folder, std::string_view name) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  // A slash at the end makes nothing, and is no failure.
  if (problem && !fs::is_directory(folder)) {
    throw Error(code_of_errno(problem.value()), "the folder cannot be made: " + problem.message(),
                {folder.string(), 0});
  }
  OutputFolder reached(folder, open_folder(folder));
  for (const fs::path& component : fs::path(name).parent_path()) {
    reached.path_ /= component;
    const int inner = open_folder_in(reached.descriptor_, component.string(), reached.path_);
    close(std::exchange(reached.descriptor_, inner));
  }
  return reached;
}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

OutputFolder::~OutputFolder() {
  if (descriptor_ >= 0) close(descriptor_);
}

void OutputFolder::write(const std::string& name, std::string_view content, bool overwrite) const {
  struct stat status = {};
  if (fstatat(descriptor_, name.c_str(), &status, 0) == 0 && !S_ISREG(status.st_mode)) {
    refuse_special(path_ / name);
  }
  TemporaryFile file(descriptor_, name, path_ / name);
  file.write(content);
  file.finish(overwrite);
}

bool OutputFolder::has(const std::string& name, std::string_view content) const {
  const int file = openat(descriptor_, name.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return false;
  struct stat status = {};
  bool same = fstat(file, &status) == 0 && S_ISREG(status.st_mode) &&
              static_cast<std::size_t>(status.st_size) == content.size();
  std::array<char, 65536> block;
  while (same && !content.empty()) {
    const ssize_t got = read(file, block.data(), block.size());
    const auto size = static_cast<std::size_t>(std::max<ssize_t>(got, 0));
    same = got > 0 && content.substr(0, size) == std::string_view(block.data(), size);
    content.remove_prefix(std::min(size, content.size()));
  }
  close(file);
  return same;
}

void OutputFolder::refuse_archive(const std::string& name, const fs::path& archive) const {
  struct stat own = {}, theirs = {};
  if (stat(archive.c_str(), &own) != 0 || fstatat(descriptor_, name.c_str(), &theirs, 0) != 0) {
    return;
  }
  if (own.st_dev != theirs.st_dev || own.st_ino != theirs.st_ino) return;
  throw FileError(ErrorCode::failed, "this is the archive itself, and is not replaced",
                  {(path_ / name).string(), 0});
}

void sync_folder(const fs::path& folder) {
  const int descriptor =
      open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // One that may be written and not read is not synced.
  if (descriptor < 0) return;
  const int number = fsync(descriptor) == 0 ? 0 : errno;
  close(descriptor);
  // Some file systems cannot.
  if (number != 0 && number != EINVAL && number != ENOTSUP && number != EROFS) {
    fail(folder, "the folder cannot be synced", number);
  }
}

void write_file_atomically(const fs::path& path, std::string_view content, bool overwrite) {
  OutputFolder::of(path).write(path.filename().string(), content, overwrite);
  sync_folder(folder_of(path));
}

void refuse_archive(const fs::path& path, const fs::path& archive) {
  std::error_code error;
  if (fs::exists(path, error)) {
    OutputFolder::of(path).refuse_archive(path.filename().string(), archive);
  }
}

void refuse_existing(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) {
    throw FileError(ErrorCode::failed, "this is a folder, not a file", {path.string(), 0});
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) refuse_special(path);
  throw FileError(ErrorCode::failed, "the file exists already", {path.string(), 0},
                  "--overwrite replaces it");
}

}  // namespace reprise::cli
