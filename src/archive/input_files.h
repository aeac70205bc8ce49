// Which files an ingest is about, and what each take is called.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "reprise/archive.h"

namespace reprise {

struct InputFile {
  std::filesystem::path path;
  std::string name;    ///< of the take: path under the ingested folder without extension, with '/'
  std::string folder;  ///< name of the folder that the file is in
};

struct InputFiles {
  std::vector<InputFile> files;  ///< by name
  std::vector<RejectedInput> rejected;
  std::map<std::string, std::size_t> other_kinds;  ///< IngestReport::other_kinds
};

/// Files are taken as they are, folders searched through for motion files; links to folders are not
/// followed, and what a Mac puts beside files (is_resource_fork) is passed over. A file that is
/// reached in several ways is one input, whatever the order of `paths`. Folders below that cannot
/// be read, and links to no file, are rejected. Throws Error (failed) for a path that is not there
/// or cannot be read. `pulse` is called again and again meanwhile; what it throws ends the search.
InputFiles find_input_files(const std::vector<std::filesystem::path>& paths,
                            const std::string& prefix, const std::function<void()>& pulse);

}  // namespace reprise
