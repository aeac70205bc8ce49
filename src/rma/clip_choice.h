// Which clips are primary, which repeat one, and which are unique (lin-2011 section 4.2.2).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rma/repeat_groups.h"

namespace reprise {

struct ClipChoiceConstants {
  /// A unique clip shorter than this merges with a neighbour (s), and none that repeats another is
  /// shorter. lin-2011 section 4.2.2.
  double least_s = 0.2;
  double least_repeated_s = 0.2;
  /// The shortest primary (s): below it a clip's row costs more than it can save.
  double least_primary_s = 0.6;
};

enum class ClipRole { primary, repeated, unique };

/// Samples [begin, end) of a take.
struct ChosenClip {
  std::size_t take = 0;
  long begin = 0;
  long end = 0;
  ClipRole role = ClipRole::unique;
  std::size_t primary = 0;  ///< of a repeated clip: the index of its primary among all clips
  /// Of a repeated clip: of each of its samples the sample of the primary's take beside it, in
  /// order and within the primary.
  std::vector<long> reference;
};

/// What it costs to code a clip by itself: equation 2. Distances are those of projected postures
/// (mm), the initial posture is the take's first.
double primary_cost(const PostureMatrix& take, long begin, long end);

/// What it costs to code a clip as differences from its reference: equation 3. `reference` has a
/// sample of `other` for each of [begin, end).
double repeated_cost(const PostureMatrix& take, long begin, long end, const PostureMatrix& other,
                     std::span<const long> reference);

/// Equation 5: the group with the greatest gain makes its reference a primary and its members
/// repeated clips, as far as they are not part of a clip yet; what is left over stays for the
/// groups after it. A primary's repeats have at least as many samples as it has. The clips of a
/// take follow one another and cover all of it. `standing` clips cover some takes already. They
/// stay, and come back at their place; others may repeat them, in groups around just these clips,
/// and then a unique one becomes primary.
std::vector<ChosenClip> choose_clips(const PostureLibrary& library,
                                     std::span<const RepeatGroup> groups,
                                     const RepeatConstants& constants,
                                     const ClipChoiceConstants& choice = {},
                                     std::span<const ChosenClip> standing = {});

}  // namespace reprise
