// How crowded the postures of a library are: what "similar" means where all is alike.
#pragma once

#include <span>
#include <vector>

#include "rma/postures.h"
#include "rma/repeat_constants.h"

namespace reprise {

/// Of each sample of each take: its reach, the distance (mm) within which `part` (0 to 1) of all
/// postures lie, itself among them. It is short where people stand and long within rare motion.
/// Large libraries are judged by a thousand or two of their postures, evenly spread. `projected`
/// are postures on the axes of one PostureBasis. `jobs` threads, 0: one a core.
std::vector<std::vector<float>> posture_reaches(std::span<const PostureMatrix> projected,
                                                double part, unsigned jobs = 1);

/// From which distance on (mm) a posture of this reach (mm) is dissimilar, in proportion to the
/// reach and, `times` as wide, for far ones (RepeatConstants::reach_mm, far_reach_power). At
/// least 1.
float similar_at_reach(float reach, const RepeatConstants& constants, float times = 1);

}  // namespace reprise
