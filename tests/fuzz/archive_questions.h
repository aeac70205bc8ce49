// What all read commands ask of an archive.
#pragma once

#include <filesystem>

namespace reprise {

/// Questions that a reader may ask of an archive; the later ones take longer.
enum class Questions { tables, verify, motion, repeats, search };
constexpr std::size_t question_kinds = 5;

/// Asks all questions of a kind. Throws what the library throws, but where it is only that a take
/// is damaged.
void ask_archive(const std::filesystem::path& path, Questions questions);

}  // namespace reprise
