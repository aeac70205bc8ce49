// Which clips are primary, which repeat one, and which are unique (lin-2011 section 4.2.2).
#pragma once

#include <span>
#include <vector>

#include "rma/chosen_clip.h"
#include "rma/repeat_groups.h"

namespace reprise {

struct ClipChoiceConstants {
  /// What recurs in no group and is shorter than this goes to the repeated clip beside it (s).
  /// lin-2011 section 4.2.2.
  double least_s = 0.2;
  /// The shortest primary and the shortest repeated clip (s).
  double least_repeated_s = 0.6;
  double least_primary_s = 0.6;
};

/// Equation 5: the group with the greatest gain makes its reference a primary and its members
/// repeated clips, as far as they are not part of a clip yet; what is left over stays for the
/// groups after it, as long as a primary's repeats have at least as many samples as it has. What is
/// in an occurrence of a group and in no clip then goes to one (complete_clips), so that a sample
/// is in a primary or repeated clip where it is in an occurrence, but for rests below
/// ClipChoiceConstants. The clips of a take follow one another and cover all of it. `standing`
/// clips cover some takes already. They stay, and come back at their place; others may repeat them,
/// in groups around just these clips, and then a unique one becomes primary.
std::vector<ChosenClip> choose_clips(const PostureLibrary& library,
                                     std::span<const RepeatGroup> groups,
                                     const RepeatConstants& constants,
                                     const ClipChoiceConstants& choice = {},
                                     std::span<const ChosenClip> standing = {});

}  // namespace reprise
