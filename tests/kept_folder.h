#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace reprise {

/// Fills `folder` by `make` and keeps a copy of it in `kept`, or copies what an earlier test kept
/// there. Tests run beside each other, each in its own process: whoever is first to rename a
/// complete copy has made it.
template <typename Make>
void fill_or_copy(const std::filesystem::path& kept, const std::filesystem::path& folder,
                  const Make& make) {
  namespace fs = std::filesystem;
  if (fs::exists(kept)) {
    fs::copy(kept, folder, fs::copy_options::recursive);
    return;
  }
  if (!make()) return;
  const fs::path draft = kept.string() + folder.filename().string();
  fs::create_directories(draft);
  fs::copy(folder, draft, fs::copy_options::recursive);
  std::error_code made_by_another;
  fs::rename(draft, kept, made_by_another);
  if (made_by_another) fs::remove_all(draft);
}

/// A name that differs where the program does.
inline std::string program_key(const std::filesystem::path& program) {
  namespace fs = std::filesystem;
  return std::to_string(fs::file_size(program)) + "-" +
         std::to_string(fs::last_write_time(program).time_since_epoch().count());
}

}  // namespace reprise
