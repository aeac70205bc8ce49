// The self-distance plot of one take (lin-2011 section 4.2), and where its paths begin.
#pragma once

#include <vector>

#include "rma/repeat_groups.h"

namespace reprise {

/// samples x samples: distance (mm) of each posture of a take to each other one.
PostureMatrix self_distances(const PostureMatrix& projected);

/// Pixels of the upper half that are least among their eight neighbours, similar, and not near the
/// diagonal; nearest first. What an index finds for a library, for a plot that fits into memory.
std::vector<NearPair> plot_minima(const PostureMatrix& distances, std::size_t take,
                                  const RepeatConstants& constants);

}  // namespace reprise
