// What repeats a clip, within parts of takes.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "rma/posture_library.h"
#include "rma/repeat_constants.h"

namespace reprise {

/// Samples [begin, end) of a take; `distance_mm` is the mean joint distance to the group's
/// reference.
struct Occurrence {
  std::size_t take = 0;
  long begin = 0;
  long end = 0;
  float distance_mm = 0;
  /// Of each sample of the reference: the sample of this take beside it. Empty for the reference.
  std::vector<long> map{};
};

/// Samples [begin, end) of a take that are to be looked at.
struct SearchedPart {
  std::size_t take = 0;
  long begin = 0;
  long end = 0;
};

/// Whether a clip is a motion and not a stance (RepeatConstants::least_speed_mm_s).
bool moves(const PostureView& clip, const RepeatConstants& constants);

/// Of a take: the mean joint distance (mm) to a clip up to which something in it repeats the clip.
using MemberLimit = std::function<float(std::size_t take)>;
/// For groups: RepeatConstants::member_mm, less where postures have to be nearer to be similar, and
/// for short clips. Refers to what it is given.
MemberLimit group_limit(const PostureLibrary& library, const Occurrence& clip,
                        const RepeatConstants& constants);
/// For a clip that somebody asks for (RepeatConstants::asked_share). Refers to what it is given.
MemberLimit asked_limit(const PostureLibrary& library, const Occurrence& clip,
                        const RepeatConstants& constants);

/// The same of a clip for which usually `usual` (mm) is the limit, and `widest` where nothing is
/// narrowed.
float asked_limit(float usual, float widest, const RepeatConstants& constants);

/// What is like the clip in any of the parts, in their order, and does not overlap it. `jobs`
/// threads, 0: one a core; results do not depend on it.
std::vector<Occurrence> find_members(const PostureLibrary& library, const Occurrence& clip,
                                     const std::vector<SearchedPart>& parts,
                                     const MemberLimit& most_mm, const RepeatConstants& constants,
                                     unsigned jobs);

}  // namespace reprise
