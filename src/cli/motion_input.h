// Motion that comes from stdin.
#pragma once

#include <filesystem>
#include <optional>

#include "reprise/formats/motion_file.h"

namespace reprise::cli {

/// An AMC where its skeleton is given, else a BVH. Throws Error: rejected_input; failed where there
/// is more than a motion file may have.
Take read_motion_from_stdin(const std::optional<std::filesystem::path>& asf,
                            const ReadOptions& options);

}  // namespace reprise::cli
