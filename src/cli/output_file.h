// Files that are either there in full or not there at all, and never outside the folder meant.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace reprise::cli {

/// `folder` / `name`, with '/' between the components of `name`. Throws Error (damaged) where a
/// name that an archive holds would lead elsewhere: absolute, empty, with a component that is
/// empty, "." or "..", or with a NUL.
std::filesystem::path path_inside(const std::filesystem::path& folder, std::string_view name);

/// Throws Error (failed) where a folder of `name` below `folder` is a symbolic link, and may thus
/// lead outside.
void refuse_links_below(const std::filesystem::path& folder, std::string_view name);

/// Writes a temporary file beside `path`, syncs it and renames it. A file that is there stays as it
/// is and an Error (failed) is thrown, unless `overwrite`. Throws Error: limit (disk full), failed.
/// The folder must exist; what is there and is no regular file, such as a device, is never
/// replaced.
void write_file_atomically(const std::filesystem::path& path, std::string_view content,
                           bool overwrite);

/// Throws Error (failed) where `path` is the file of `archive`: nothing taken out of an archive
/// replaces it.
void refuse_archive(const std::filesystem::path& path, const std::filesystem::path& archive);

/// Makes the folder that `file` shall be in, with those above it. Throws Error (failed or limit).
void make_folder_of(const std::filesystem::path& file);

/// True if the file is there and has exactly this content.
bool file_has_content(const std::filesystem::path& path, std::string_view content);

/// The Error (failed) for a file that exists.
[[noreturn]] void refuse_existing(const std::filesystem::path& path);

}  // namespace reprise::cli
