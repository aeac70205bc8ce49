// The files that an archive's takes came from, found again by the takes' names.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "reprise/archive.h"

namespace reprise {

/// Motion files below a folder by the names that an ingest of it gives takes, and by the ends of
/// those that no other file has: an ingest of the files themselves gives takes no folder.
class SourceFolder {
 public:
  /// Calls `pulse` again and again; what it throws ends the search. Throws Error (failed) where the
  /// folder itself cannot be read.
  SourceFolder(const std::filesystem::path& folder, const std::function<void()>& pulse);

  /// Null where there is none of the take's format.
  const std::filesystem::path* source_of(const TakeInfo& take) const;
  /// Folders below that could not be read, and why.
  const std::vector<Damage>& unread() const { return unread_; }

 private:
  using Key = std::pair<MotionFormat, std::string>;
  std::map<Key, std::filesystem::path> sources_;
  std::vector<Damage> unread_;
};

}  // namespace reprise
