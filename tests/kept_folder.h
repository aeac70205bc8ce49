#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace reprise {

/// While it lives, no other process has one of the same file.
class FileLock {
 public:
  explicit FileLock(const std::filesystem::path& file)
      : descriptor_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    flock(descriptor_, LOCK_EX);
  }
  ~FileLock() { close(descriptor_); }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_;
};

/// Fills `folder` by `make` and keeps a copy of it in `kept`, or copies what an earlier test kept
/// there. Tests run beside each other, each in its own process: whoever comes second waits for the
/// first one's copy, which is renamed when it is complete.
template <typename Make>
void fill_or_copy(const std::filesystem::path& kept, const std::filesystem::path& folder,
                  const Make& make) {
  namespace fs = std::filesystem;
  fs::create_directories(kept.parent_path());
  const FileLock lock(kept.string() + ".lock");
  if (fs::exists(kept)) {
    fs::copy(kept, folder, fs::copy_options::recursive);
    return;
  }
  if (!make()) return;
  const fs::path draft = kept.string() + folder.filename().string();
  fs::create_directories(draft);
  fs::copy(folder, draft, fs::copy_options::recursive);
  fs::rename(draft, kept);
}

/// A name that differs where the program does.
inline std::string program_key(const std::filesystem::path& program) {
  namespace fs = std::filesystem;
  return std::to_string(fs::file_size(program)) + "-" +
         std::to_string(fs::last_write_time(program).time_since_epoch().count());
}

}  // namespace reprise
