#include "archive/input_files.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <new>
#include <optional>
#include <set>
#include <tuple>

#include "reprise/error.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

/// Of the folder that the file is named in, also where the file is a link to another one.
std::string folder_name(const fs::path& file) {
  std::error_code ignored;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  fs::path full = fs::weakly_canonical(folder, ignored);
  if (ignored) full = folder;
  return full.filename().generic_string();
}

/// Why what a folder holds under this name cannot be taken in; nothing where it can, or is not
/// meant.
std::optional<RejectedInput> hindrance(const fs::directory_entry& entry) {
  const std::string path = entry.path().string();
  std::error_code error;
  if (entry.is_symlink(error)) {
    const bool lost = is_motion_file(entry.path()) && !entry.exists(error);
    if (!lost) return std::nullopt;
    return RejectedInput{path, 0, "the link leads to no file", "mend the link, or remove it"};
  }
  if (!entry.is_directory(error)) return std::nullopt;
  const fs::directory_iterator probe(entry.path(), error);
  if (error == std::errc::not_enough_memory) throw std::bad_alloc();
  if (!error) return std::nullopt;
  return RejectedInput{path, 0, "the folder cannot be read: " + error.message(),
                       "make it readable, or name what is wanted beside it"};
}

bool is_hidden(const fs::path& path) { return path.filename().string().starts_with('.'); }

/// Whether a folder's file is meant to be taken in, by its name.
bool is_wanted(const fs::path& path) {
  return is_motion_file(path) && path.has_extension() && !is_resource_fork(path);
}

/// What a file that is passed over counts as; nothing where it does not count.
std::optional<std::string> other_kind(const fs::path& relative) {
  if (is_skeleton_file(relative)) return std::nullopt;
  const fs::path name = relative.filename();
  const bool only_ending = is_motion_file(name) && !name.has_extension();
  const bool hidden = std::ranges::any_of(relative, is_hidden);
  if (hidden && !only_ending) return std::nullopt;
  std::string kind = (only_ending ? name : name.extension()).string();
  for (char& c : kind) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return kind;
}

/// The files of one argument, with their paths under it.
std::vector<std::pair<fs::path, fs::path>> files_under(const fs::path& path, InputFiles& inputs,
                                                       const std::function<void()>& pulse) {
  std::vector<std::pair<fs::path, fs::path>> found;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (error || !fs::exists(status)) {
    throw Error(ErrorCode::failed, "there is no such file or folder", {path.string()});
  }
  if (!fs::is_directory(status)) {
    // `folder/*` names skeletons, too; they are read with the AMC files beside them.
    if (!is_skeleton_file(path)) found.emplace_back(path, path.filename());
    return found;
  }
  const fs::directory_iterator probe(path, error);
  if (error) {
    throw Error(code_of_errno(error.value()), "the folder cannot be read: " + error.message(),
                {path.string()});
  }
  fs::recursive_directory_iterator entry(path, fs::directory_options::skip_permission_denied,
                                         error);
  if (error) {
    throw Error(code_of_errno(error.value()), "the folder cannot be read", {path.string()});
  }
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    pulse();
    if (auto rejected = hindrance(*entry)) inputs.rejected.push_back(std::move(*rejected));
    std::error_code ignored;
    if (!entry->is_regular_file(ignored)) continue;
    const fs::path relative = entry->path().lexically_relative(path);
    if (is_wanted(relative)) {
      found.emplace_back(entry->path(), relative);
    } else if (const auto kind = other_kind(relative)) {
      ++inputs.other_kinds[*kind];
    }
  }
  // An error ends the loop.
  if (error) {
    throw Error(code_of_errno(error.value()),
                "the folder cannot be searched to its end: " + error.message(), {path.string()});
  }
  return found;
}

/// A file, and what its names are chosen by: it may be reached in several ways.
struct FoundFile {
  fs::path full;  ///< the file itself
  bool is_link = false;
  std::ptrdiff_t missing_folders = 0;  ///< the fewer, the more folders `relative` has
  fs::path relative;                   ///< path under the argument
  fs::path path;

  auto order() const { return std::tie(full, is_link, missing_folders, relative, path); }
};

/// Each file once: by a name of its own rather than a link's, and with the most folders in it. The
/// order of arguments, and that of a folder's entries, do not matter.
std::vector<FoundFile> files_of(const std::vector<fs::path>& arguments, InputFiles& inputs,
                                const std::function<void()>& pulse) {
  std::vector<FoundFile> files;
  for (const fs::path& argument : arguments) {
    for (auto& [path, relative] : files_under(argument, inputs, pulse)) {
      pulse();
      std::error_code ignored;
      const fs::path full = fs::weakly_canonical(path, ignored);
      if (ignored == std::errc::not_enough_memory) throw std::bad_alloc();
      files.push_back({full.empty() ? path : full, fs::is_symlink(path, ignored),
                       -std::distance(relative.begin(), relative.end()), relative, path});
    }
  }
  std::ranges::sort(files, {}, &FoundFile::order);
  const auto same = [](const FoundFile& a, const FoundFile& b) { return a.full == b.full; };
  files.erase(std::unique(files.begin(), files.end(), same), files.end());
  return files;
}

std::string name_without_extension(const fs::path& path) {
  fs::path name = path;
  return name.replace_extension().generic_string();
}

}  // namespace

InputFiles find_input_files(const std::vector<fs::path>& paths, const std::string& prefix,
                            const std::function<void()>& pulse) {
  InputFiles result;
  std::map<std::string, std::vector<std::pair<fs::path, fs::path>>> by_name;
  for (const FoundFile& file : files_of(paths, result, pulse)) {
    by_name[name_without_extension(file.relative)].emplace_back(file.path, file.relative);
  }
  std::set<std::string> used;
  for (auto& [name, files] : by_name) {
    std::sort(files.begin(), files.end());
    std::set<fs::path> spellings;
    for (const auto& [path, relative] : files) spellings.insert(relative);
    for (const auto& [path, relative] : files) {
      // x.bvh beside x.amc: the extension tells them apart.
      std::string own = spellings.size() == 1 ? name : relative.generic_string();
      if (!prefix.empty()) own = prefix + "/" + own;
      if (!used.insert(own).second) {
        result.rejected.push_back({path.string(), 0,
                                   "another file of this ingest has the name '" + own + "' too",
                                   "ingest the folders one by one with --prefix"});
        continue;
      }
      result.files.push_back({path, own, folder_name(path)});
    }
  }
  std::sort(result.files.begin(), result.files.end(),
            [](const InputFile& a, const InputFile& b) { return a.name < b.name; });
  return result;
}

}  // namespace reprise
