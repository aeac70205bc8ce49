#include "query/source_folder.h"

#include <new>
#include <set>

#include "reprise/error.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

/// Calls `use` with a name, and with what is left of it after each of its slashes.
template <class Use>
void for_each_end(const std::string& name, const Use& use) {
  for (std::size_t at = 0; at != std::string::npos;) {
    use(name.substr(at));
    const std::size_t slash = name.find('/', at);
    at = slash == std::string::npos ? slash : slash + 1;
  }
}

/// Why a folder below cannot be searched; empty where it can, or is none.
std::string hindrance(const fs::directory_entry& entry) {
  std::error_code error;
  // Links to folders are not followed.
  if (entry.is_symlink(error) || !entry.is_directory(error)) return {};
  const fs::directory_iterator probe(entry.path(), error);
  if (error == std::errc::not_enough_memory) throw std::bad_alloc();
  return error ? "the folder cannot be read: " + error.message() : std::string();
}

}  // namespace

SourceFolder::SourceFolder(const fs::path& folder, const std::function<void()>& pulse) {
  std::map<Key, std::vector<fs::path>> by_end;
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw Error(ErrorCode::failed,
                fs::exists(folder, error) ? "this is not a folder" : "there is no such folder",
                {folder.string()});
  }
  const fs::directory_iterator probe(folder, error);
  fs::recursive_directory_iterator entry;
  if (!error) entry = {folder, fs::directory_options::skip_permission_denied, error};
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    pulse();
    const std::string why = hindrance(*entry);
    if (!why.empty()) unread_.push_back({entry->path().string(), why, true});
    std::error_code ignored;
    const std::optional<MotionFormat> format = motion_format_of(entry->path());
    if (!entry->is_regular_file(ignored) || !format || is_resource_fork(entry->path())) continue;
    fs::path relative = entry->path().lexically_relative(folder);
    // A name that is an ending and nothing else has no other.
    for (const std::string& name : std::set<std::string>{
             relative.generic_string(), relative.replace_extension().generic_string()}) {
      sources_.emplace(Key(*format, name), entry->path());
      for_each_end(name, [&](const std::string& end) {
        by_end[{*format, end}].push_back(entry->path());
      });
    }
  }
  if (error) {
    throw Error(code_of_errno(error.value()), "the folder cannot be read: " + error.message(),
                {folder.string()});
  }
  for (const auto& [end, files] : by_end) {
    if (files.size() == 1) sources_.emplace(end, files.front());
  }
}

const fs::path* SourceFolder::source_of(const TakeInfo& take) const {
  const fs::path* source = nullptr;
  // A prefix of the ingest stands before the name under the folder.
  for_each_end(take.name, [&](const std::string& end) {
    const auto found = sources_.find({take.format, end});
    if (source == nullptr && found != sources_.end()) source = &found->second;
  });
  return source;
}

}  // namespace reprise
