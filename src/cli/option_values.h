// How the values of options are read. Nothing here depends on the locale.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

#include "reprise/archive.h"

namespace reprise::cli {

/// Throws Error (usage): the option takes what is wanted, not `text`.
[[noreturn]] void refuse_value(std::string_view option, std::string_view text,
                               std::string_view wanted);

/// All of `text` as a number, or nothing.
template <typename T>
std::optional<T> read_all(std::string_view text) {
  T value{};
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end) return std::nullopt;
  return value;
}

/// The whole of `text` as a number from `least` to `most`. Throws Error (usage) that names
/// `option`. Independent of the locale; no hexadecimal, no infinity.
double parse_number(std::string_view option, std::string_view text, double least, double most);
std::uint64_t parse_whole_number(std::string_view option, std::string_view text,
                                 std::uint64_t least, std::uint64_t most);

/// "preview", "standard", "fine" or "exact". Throws Error (usage).
FidelityTier parse_tier(std::string_view text);

/// "bvh" or "amc". Throws Error (usage).
MotionFormat parse_motion_format(std::string_view text);

}  // namespace reprise::cli
