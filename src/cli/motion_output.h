// Takes written into files.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cli/output_file.h"
#include "reprise/model/skeleton.h"

namespace reprise::cli {

/// Writes takes of an archive into files, each AMC with its ASF.
class MotionOutput {
 public:
  MotionOutput(const std::filesystem::path& archive, bool overwrite)
      : archive_(archive), overwrite_(overwrite) {}

  /// Writes the motion (`text`) as the file `name` of a folder. Returns the files written, the
  /// motion first. Throws what OutputFolder::write does; damaged where the archive names a skeleton
  /// in another folder.
  std::vector<std::filesystem::path> write(const Skeleton& skeleton, const std::string& text,
                                           const OutputFolder& folder, const std::string& name);
  /// Makes what was written last through a loss of power: the folders, and those above them up to
  /// that of `top`. Throws Error (failed, limit).
  void sync(const std::filesystem::path& top) const;

 private:
  /// Takes of one folder usually share their ASF: it is written once, and stays where it is there
  /// already.
  std::filesystem::path write_skeleton(const Skeleton& skeleton, const OutputFolder& folder,
                                       const std::string& motion);

  std::filesystem::path archive_;
  bool overwrite_;
  std::map<std::string, std::string> written_;  ///< path of an ASF and its text
  std::set<std::filesystem::path> folders_;     ///< that were written into
};

}  // namespace reprise::cli
