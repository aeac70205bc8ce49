// How large an archive would get and how long that would take, from a few of its takes.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "archive/take_identity.h"
#include "reprise/archive.h"

namespace reprise {

/// Stores some of the takes, spread over all, in an archive of its own in the system's folder for
/// temporary files, and takes it away again. Nothing where there is no take, or none can be stored
/// there. `pulse` is called again and again; what it throws ends it.
std::optional<IngestEstimate> estimate_ingest(const std::vector<FreshTake>& takes,
                                              const IngestOptions& options,
                                              const std::function<void()>& pulse);

}  // namespace reprise
