// The postures of all takes of an archive.
#pragma once

#include <filesystem>
#include <vector>

#include "query/posture_track.h"
#include "reprise/query/motion_search.h"
#include "store/archive_store.h"

namespace reprise {

struct LibraryTake {
  std::string name;
  std::string subject;
  double seconds = 0;
  Digest key{};  ///< of all that its postures depend on
  PostureTrack track;
};

/// All takes, by name. Takes whose postures `cached` (sorted by key) has are not decoded. Throws
/// what Archive throws. A writer may add and remove takes meanwhile: the result is the state at one
/// time.
std::vector<LibraryTake> read_library(const std::filesystem::path& archive,
                                      const SearchSetup& setup, std::vector<LibraryTake> cached,
                                      const ProgressSink& progress);

/// The takes in a cache; none where it is missing, damaged, or of another version: it is made again
/// then. Names and subjects are left out.
std::vector<LibraryTake> read_feature_cache(const std::filesystem::path& file);

/// Replaces the file as a whole. `content` is the archive's content digest. Throws Error (failed,
/// limit).
void write_feature_cache(const std::filesystem::path& file, const Digest& content,
                         const std::vector<LibraryTake>& takes);
/// The archive's content digest that a cache says it was made for; none if it is no cache.
std::optional<Digest> content_of_cache(const std::filesystem::path& file);

}  // namespace reprise
