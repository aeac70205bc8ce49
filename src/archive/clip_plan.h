// Into which clips the takes of an ingest are cut, and which of them repeat which.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "archive/space_builder.h"

namespace reprise {

/// Repeats are those that `repeats` tells (RepeatConstants, NearWindowConstants); this is what is
/// made of them.
struct ClipPlanConstants {
  /// Unique clips shorter than this join the repeated clip beside them (s). lin-2011 section 4.2.
  double least_rest_s = 0.2;
  /// The shortest part of a unique clip that is cut where behaviours meet (s).
  double least_part_s = 1.5;
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
