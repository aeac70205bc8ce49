// Links from clips to the clips that they repeat, once all takes of an ingest are stored.
#pragma once

#include <set>
#include <string>

#include "archive/clip_plan.h"
#include "store/archive_store.h"

namespace reprise {

/// Stores the kinds of a plan's clips and their primaries in one transaction. `added` are the takes
/// of the plan that came to be stored; clips of others are left out, and primaries that are left
/// without a repeat stay unique.
void link_clips(ArchiveStore& store, const ClipPlan& plan, const std::set<std::string>& added);

}  // namespace reprise
