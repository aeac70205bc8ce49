// An archive with a little of everything, the same in every process: BVH and AMC takes at each
// fidelity, one of which extends the axes of those before it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "query/archive_impl.h"

namespace reprise {

/// Made at the first call, in the scratch folder.
const std::filesystem::path& sample_archive();

/// Takes of `sample_archive` by name, with the data of their layers.
std::vector<TakeRecord> sample_records(const ArchiveStore& store);

}  // namespace reprise
