// A file that is made under another name, and gets its own when it is complete.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace reprise {

/// An empty file `TARGET.new-` and 16 hexadecimal digits that nobody can foretell, in the folder of
/// the target. No link is followed, and nothing that is there is written to. It is locked (flock)
/// for as long as this object lives, and goes with it unless it was given its name: what is found
/// without a lock was left by a process that died.
class NewFile {
 public:
  /// Throws Error (limit where there is no room, else failed): `what` and why, of the target.
  NewFile(const std::filesystem::path& target, std::string_view what);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Throws Error, as above.
  void write(std::string_view text);
  /// Gives it the target's name, in place of what is there. Throws Error.
  void replace();
  /// Gives it the target's name, unless there is something: false. Throws Error.
  bool place();

 private:
  [[noreturn]] void fail(int number) const;

  std::filesystem::path target_;
  std::string what_;
  std::filesystem::path path_;
  int descriptor_ = -1;
  bool named_ = false;
};

/// Takes away what processes that died have left of such files in a folder, and the journals beside
/// them: those of the target of this name, or of any.
void remove_dead_new_files(const std::filesystem::path& folder, std::string_view target = {});

/// Makes what was named, renamed or removed in the folder of `file` last through a loss of power.
/// Throws Error (limit or failed) with the file. A file system that cannot do it is left alone.
void sync_folder_of(const std::filesystem::path& file);

/// Whether the file of a descriptor is still the one of that path.
bool is_file_of(int descriptor, const std::filesystem::path& path);

}  // namespace reprise
