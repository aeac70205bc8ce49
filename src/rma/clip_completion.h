// What recurs and is not part of a clip yet.
#pragma once

#include <span>
#include <vector>

#include "rma/chosen_clip.h"
#include "rma/repeat_groups.h"

namespace reprise {

/// Gives what is in an occurrence of a group, and in no clip, to a clip, so that clips and groups
/// say the same of what recurs. A stretch of at least `least` samples repeats the primary that has
/// the most of what another occurrence of its group has beside it; where no clip has any of that,
/// it becomes a primary first. Shorter ones go to the clip before them, or to the one after them.
/// The first `standing` clips stay as they are, but for unique ones that become primary. Takes have
/// so many `samples`; `clips` do not overlap.
void complete_clips(std::vector<ChosenClip>& clips, std::span<const RepeatGroup> groups,
                    std::span<const long> samples, long least, std::size_t standing);

}  // namespace reprise
