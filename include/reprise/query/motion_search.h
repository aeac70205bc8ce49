// Search by example: which takes of an archive hold a motion like this one.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reprise/archive.h"
#include "reprise/query/body_joints.h"

namespace reprise {

/// How a search is made ready.
struct SearchSetup {
  JointMap joint_map;        ///< corrects the matching of every skeleton that has such joints
  bool write_cache = false;  ///< keep what was computed in `search_cache_path`, if it can be
  unsigned jobs = 0;         ///< worker threads, 0: one a core; results do not depend on it
};

struct SearchOptions {
  /// Only this part of the example, in seconds; all of it without them.
  std::optional<double> from;
  std::optional<double> to;
  std::size_t top = 20;
  std::optional<double> limit_mm;  ///< leave out what is further away
  bool across_subjects = false;    ///< leave out the subject of the example
  bool all_occurrences = false;    ///< all stretches of a take that fit, not only the best one
};

struct SearchResult {
  std::string take;
  std::string subject;
  double start = 0;  ///< seconds
  double end = 0;
  /// Mean distance of the body's joints along the best time alignment, heading and place taken out,
  /// on a body of one size.
  double distance_mm = 0;
  /// What the order of the rest goes by, least first: a third (a quarter, for a whole example) is
  /// the course of the motion, the rest mean and deviation of its postures, bearing hardly counting
  /// (in mm; docs/cli.md).
  double unlikeness = 0;
  /// Whether it repeats the example: as near as what Archive::repeats tells for a part that is
  /// asked for, at a third to three times its speed, and nearer than 0.45 of what its own postures
  /// are from their mean.
  bool repeat = false;
};

/// Where a search keeps what it computes of an archive, if asked to: beside it, with ".features" at
/// the end of the name. The file may be deleted at any time.
std::filesystem::path search_cache_path(const std::filesystem::path& archive);

/// An archive made ready for search: postures of all takes are decoded, or read from the cache,
/// which is used where it is there, whole, and fits; takes that it lacks are decoded. It shows the
/// archive as it was when this was made. One thread at a time may ask.
class MotionSearch {
 public:
  /// Throws what Archive throws; Error (interrupted) where `progress` says so.
  explicit MotionSearch(const std::filesystem::path& archive, const SearchSetup& setup = {},
                        const ProgressSink& progress = {});
  ~MotionSearch();
  MotionSearch(MotionSearch&&) noexcept;
  MotionSearch& operator=(MotionSearch&&) noexcept;

  /// Why the cache that was asked for could not be written, in a sentence; else empty. Answers do
  /// not depend on it.
  const std::string& cache_problem() const;

  /// Takes like a take that need not be in the archive, repeats of the example first, by
  /// distance, then the rest by unlikeness. A whole example is compared
  /// with whole takes, and with parts of takes more than twice as long; a part of one with all
  /// parts of that length, at half to twice the speed. Nothing, where no take has a body that could
  /// be compared. Throws Error (usage) where from and to are not in the example.
  std::vector<SearchResult> like(const Take& example, const SearchOptions& options = {});

  /// The same for a take of the archive. It is not found itself, but for other parts of it.
  /// Throws Error (not_found) for a take that is not there.
  std::vector<SearchResult> like(const TakeInfo& example, const SearchOptions& options = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace reprise
