// The steps of a path through the plot of two motions (lin-2011 section 4.1).
#pragma once

#include <array>

#include "rma/repeat_constants.h"

namespace reprise {

/// Samples that a step goes on by in each of the two motions.
struct PathStep {
  int x;
  int y;
};

/// The diagonal first: it wins ties.
constexpr std::array<PathStep, 5> path_steps{{{1, 1}, {1, 2}, {2, 1}, {1, 3}, {3, 1}}};
static_assert(RepeatConstants::steepest == 3);

}  // namespace reprise
