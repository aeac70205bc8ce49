// The formats that extract writes, by the ends of file names: one table for all that asks.
#pragma once

#include <filesystem>
#include <string>

#include "reprise/archive.h"

namespace reprise::cli {

/// Throws Error (usage), with advice, where a file's name ends as that of a format that is never
/// written: walk.fbx. Names without an ending, or with one without a letter (walk_1.5), are taken.
void check_written_ending(const std::filesystem::path& file);

/// The same where the name is for another format than that of the take.
void check_written_ending(const std::filesystem::path& file, const TakeInfo& take);

}  // namespace reprise::cli
