// Files that are written as a whole; read_whole_file reads one.
#pragma once

#include <filesystem>
#include <string_view>

namespace reprise {

/// Makes or replaces the file: it appears under its name when it is complete, and is made under one
/// that nobody can foretell. For what can be made again: a loss of power may undo it. Throws Error:
/// `what` and why, of that file; limit where there is no room for it, else failed. Nothing is left
/// then.
void write_whole_file(const std::filesystem::path& path, std::string_view text,
                      std::string_view what = "the file cannot be written");

}  // namespace reprise
