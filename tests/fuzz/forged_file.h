// An archive file with changes that a forger may make: rows with right digests, and pages with
// right checksums.
#pragma once

#include <filesystem>
#include <string>

#include "fuzz/fuzz_input.h"

namespace reprise {

/// Changes what a block says of its takes, or their coded motion, and makes its digest right. Which
/// block is the input's choice. An edit takes 6 to 22 bytes of it.
void edit_block(const std::filesystem::path& archive, FuzzInput& input);

/// Writes over up to 8 bytes of a file, and makes the checksums of its pages right.
void edit_file(std::string& bytes, FuzzInput& input);

}  // namespace reprise
