// Takes written into files.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "reprise/model/skeleton.h"

namespace reprise::cli {

/// Writes takes of an archive into files, each AMC with its ASF.
class MotionOutput {
 public:
  MotionOutput(const std::filesystem::path& archive, bool overwrite)
      : archive_(archive), overwrite_(overwrite) {}

  /// Returns the files written, the motion (`text`) first. Throws what write_file_atomically does;
  /// damaged where the archive names a skeleton in another folder.
  std::vector<std::filesystem::path> write(const Skeleton& skeleton, const std::string& text,
                                           const std::filesystem::path& target);

 private:
  /// Takes of one folder usually share their ASF: it is written once, and stays where it is there
  /// already.
  std::filesystem::path write_skeleton(const Skeleton& skeleton,
                                       const std::filesystem::path& motion);

  std::filesystem::path archive_;
  bool overwrite_;
  std::map<std::string, std::string> written_;  ///< path of an ASF and its text
};

}  // namespace reprise::cli
