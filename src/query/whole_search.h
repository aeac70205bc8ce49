// Search for a whole example among whole takes.
#pragma once

#include <vector>

#include "query/search_example.h"

namespace reprise {

/// The `count` of the group's takes that are summed up most alike, of those that `accept` (one for
/// each of them) says yes of, compared in full. The group's ranking is made if it is not there.
std::vector<Match> whole_matches(const std::vector<LibraryTake>& library, PlanGroup& group,
                                 const Example& example, const std::vector<bool>& accept,
                                 std::size_t count);

}  // namespace reprise
