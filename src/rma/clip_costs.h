// What it costs to code a clip, estimated before anything is coded (lin-2011 section 4.2.2).
#pragma once

#include <span>

#include "rma/postures.h"

namespace reprise {

/// What it costs to code a clip by itself: equation 2. Distances are those of projected postures
/// (mm), the initial posture is the take's first.
double primary_cost(const PostureMatrix& take, long begin, long end);

/// What it costs to code a clip as differences from its reference: equation 3. `reference` has a
/// sample of `other` for each of [begin, end).
double repeated_cost(const PostureMatrix& take, long begin, long end, const PostureMatrix& other,
                     std::span<const long> reference);

}  // namespace reprise
