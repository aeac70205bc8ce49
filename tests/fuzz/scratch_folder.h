// A folder of this process, in memory where the machine has such a place.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace reprise {

/// Made at the first call, taken away when the process ends as it should.
const std::filesystem::path& scratch_folder();

/// Replaces the file as a whole.
void write_scratch(const std::filesystem::path& path, std::string_view bytes);
std::string read_scratch(const std::filesystem::path& path);

}  // namespace reprise
