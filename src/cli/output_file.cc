#include "cli/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include "reprise/error.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

[[noreturn]] void fail(const fs::path& path, std::string_view what, int number) {
  throw Error(code_of_errno(number), fmt::format("{}: {}", what, std::strerror(number)),
              {path.string(), 0});
}

[[noreturn]] void refuse_special(const fs::path& path) {
  throw Error(ErrorCode::failed, "this is not a regular file, and is not replaced",
              {path.string(), 0}, "-o - writes to stdout");
}

/// A new file beside the one meant. It is gone when this ends, unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : target_(target) {
    path_ = (target.parent_path() / ".reprise-XXXXXX").string();
    descriptor_ = mkostemp(path_.data(), O_CLOEXEC);
    if (descriptor_ < 0) fail(target_, "the file cannot be created", errno);
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!renamed_) unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::string_view content) {
    while (!content.empty()) {
      const ssize_t written = ::write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(target_, "the file cannot be written", errno);
      content.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void finish(bool overwrite) {
    // mkostemp makes files for the owner alone; what comes out is as any other new file.
    const mode_t mask = umask(0);
    umask(mask);
    if (fchmod(descriptor_, 0666 & ~mask) != 0) fail(target_, "the file cannot be written", errno);
    if (fsync(descriptor_) != 0) fail(target_, "the file cannot be written", errno);
    const int closed = close(std::exchange(descriptor_, -1));
    if (closed != 0) fail(target_, "the file cannot be written", errno);
    rename_to_target(overwrite);
    renamed_ = true;
  }

 private:
  void rename_to_target(bool overwrite) {
    if (!overwrite) {
      const int result =
          renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE);
      if (result == 0) return;
      if (errno == EEXIST) refuse_existing(target_);
      // Some file systems cannot do this in one step.
      if (errno != EINVAL && errno != ENOSYS) fail(target_, "the file cannot be renamed", errno);
      if (fs::exists(fs::symlink_status(target_))) refuse_existing(target_);
    }
    if (rename(path_.c_str(), target_.c_str()) != 0) {
      fail(target_, "the file cannot be renamed", errno);
    }
  }

  fs::path target_;
  std::string path_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

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

void refuse_links_below(const fs::path& folder, std::string_view name) {
  fs::path step = folder;
  for (const fs::path& component : fs::path(name).parent_path()) {
    step /= component;
    if (fs::is_symlink(fs::symlink_status(step))) {
      throw Error(ErrorCode::failed,
                  "a symbolic link stands where a folder of the output belongs; it is not followed",
                  {step.string(), 0});
    }
  }
}

void write_file_atomically(const fs::path& path, std::string_view content, bool overwrite) {
  const fs::file_status status = fs::status(path);
  if (fs::exists(status) && !fs::is_regular_file(status)) refuse_special(path);
  TemporaryFile file(path);
  file.write(content);
  file.finish(overwrite);
}

void refuse_archive(const fs::path& path, const fs::path& archive) {
  std::error_code error;
  if (!fs::equivalent(path, archive, error) || error) return;
  throw Error(ErrorCode::failed, "this is the archive itself, and is not replaced",
              {path.string(), 0});
}

void make_folder_of(const fs::path& file) {
  std::error_code problem;
  fs::create_directories(file.parent_path(), problem);
  if (problem) fail(file.parent_path(), "the folder cannot be made", problem.value());
}

bool file_has_content(const fs::path& path, std::string_view content) {
  std::error_code error;
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) != content.size()) {
    return false;
  }
  std::ifstream stream(path, std::ios::binary);
  const std::string found((std::istreambuf_iterator<char>(stream)),
                          std::istreambuf_iterator<char>());
  return found == content;
}

void refuse_existing(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) {
    throw Error(ErrorCode::failed, "this is a folder, not a file", {path.string(), 0});
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) refuse_special(path);
  throw Error(ErrorCode::failed, "the file exists already", {path.string(), 0},
              "--overwrite replaces it");
}

}  // namespace reprise::cli
