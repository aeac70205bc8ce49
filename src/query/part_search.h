// Search for an example in parts of takes.
#pragma once

#include <vector>

#include "query/search_example.h"

namespace reprise {

/// Stretches of the group's takes that `accept` (one for each of them) says yes of, at half to
/// twice the example's speed: the `count` that most windows vote for, where the example fits best
/// about each of them and, for a part of a take, about the best places. Many are alike. The group's
/// windows are made if they are not there.
std::vector<Match> part_matches(const std::vector<LibraryTake>& library, PlanGroup& group,
                                const Example& example, const std::vector<bool>& accept,
                                std::size_t count);

}  // namespace reprise
