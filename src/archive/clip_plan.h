// Into which clips the takes of an ingest are cut, and which of them repeat which.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "archive/space_builder.h"

namespace reprise {

struct ClipPlanConstants {
  /// Postures a second. Slower than where repeats are asked for: every take is looked at here.
  double rate = 10;
  /// The shortest primary and repeated clip (s), and what is shorter than the other joins the clip
  /// beside it (s). lin-2011 section 4.2 has 0.6 s of a path, which is 0.3 s of a take, and 0.2 s;
  /// there, what clips take would be a tenth of an archive
  /// (docs/findings/2026-11-25-behaviours.md).
  double least_clip_s = 1.5;
  double least_rest_s = 0.5;
  /// As RepeatConstants::across_subjects. Wider: a primary's repeats cannot lead on to others.
  float across_subjects = 1.75F;
  /// Windows for candidates: how many neighbours each looks for, and how far they are apart (s).
  std::size_t neighbours = 6;
  double hop_s = 0.5;
  /// As NearWindowConstants::most_looks. An archive of 989 takes is the same without a limit; where
  /// thousands of windows are equal, or noise, it is what keeps the cost of a take.
  long most_looks = 1000;
  /// No repeats are looked for around a clip of which this part is explained by others.
  double explained_cover = 0.5;
  /// Stored takes that new ones are compared with, in all and for each of them, so that few new
  /// ones cost little; those with primaries come first.
  std::size_t most_stored_takes = 256;
  std::size_t stored_takes_per_new = 16;
};

/// A clip of a take by name.
struct PlannedPlace {
  std::string take;
  std::size_t index = 0;
};

struct PlannedClip {
  long first_frame = 0;
  long frames = 0;
  ClipKind kind = ClipKind::unique;
  std::int64_t group = 0;
  PlannedPlace primary;  ///< of a repeated clip
};

/// Of each new take by name: its clips, which follow one another and cover it. Clips of stored
/// takes that they repeat become primary.
struct ClipPlan {
  std::map<std::string, std::vector<PlannedClip>> takes;
};

/// Looks at every one of `takes` once, and at stored takes of the same skeletons. Stored clips stay
/// as they are: new ones may repeat them and join their groups. Nothing depends on the number of
/// threads. `archive` must not be within a transaction. `tick` hears of each take.
/// Throws Error: rejected_input where a file is no longer what was outlined, damaged.
ClipPlan plan_clips(const std::filesystem::path& archive, const std::vector<FreshTake>& takes,
                    const std::map<std::string, SpaceAssignment>& spaces,
                    const IngestOptions& options,
                    const std::function<void(const std::string&)>& tick);

}  // namespace reprise
