// Files that are either there in full or not there at all, and never outside the folder meant.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "reprise/error.h"

namespace reprise::cli {

/// What is wrong with one file alone, its name or what stands in its place: others can be written.
class FileError : public Error {
 public:
  using Error::Error;
};

/// `folder` / `name`, with '/' between the components of `name`. Throws Error (damaged) where a
/// name that an archive holds would lead elsewhere: absolute, empty, with a component that is
/// empty, "." or "..", or with a NUL.
std::filesystem::path path_inside(const std::filesystem::path& folder, std::string_view name);

/// A folder that is held open while files are written into it: what is done to its path meanwhile,
/// such as a link that is put in the place of a folder above it, leads them nowhere else.
class OutputFolder {
 public:
  /// The folder of `file`, as its path leads there. Throws Error (failed, limit).
  static OutputFolder of(const std::filesystem::path& file);
  /// The folder of the file `name` below `folder`; both are made where they are not there. Below
  /// `folder` no link is followed. Throws FileError where a link or a file stands in the way, else
  /// Error (failed, limit).
  static OutputFolder below(const std::filesystem::path& folder, std::string_view name);
  ~OutputFolder();
  OutputFolder(OutputFolder&& other) noexcept;
  OutputFolder& operator=(OutputFolder&&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Writes a file beside `name`, syncs it and renames it. A file that is there stays as it is and
  /// a FileError (failed) is thrown, unless `overwrite`; what is there and is no regular file, such
  /// as a device, is never replaced. Throws Error: limit (disk full), failed.
  void write(const std::string& name, std::string_view content, bool overwrite) const;
  /// True if the file is there and has exactly this content.
  bool has(const std::string& name, std::string_view content) const;
  /// Throws Error (failed) where the file of this name is that of `archive`: nothing taken out of
  /// an archive replaces it.
  void refuse_archive(const std::string& name, const std::filesystem::path& archive) const;

 private:
  OutputFolder(std::filesystem::path path, int descriptor)
      : path_(std::move(path)), descriptor_(descriptor) {}

  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// Makes what was named in a folder last through a loss of power. Throws Error (failed, limit).
void sync_folder(const std::filesystem::path& folder);

/// OutputFolder::write into the folder of `path`, which must exist; lasting.
void write_file_atomically(const std::filesystem::path& path, std::string_view content,
                           bool overwrite);

/// OutputFolder::refuse_archive for a path.
void refuse_archive(const std::filesystem::path& path, const std::filesystem::path& archive);

/// The error (failed) for a file that exists.
[[noreturn]] void refuse_existing(const std::filesystem::path& path);

}  // namespace reprise::cli
