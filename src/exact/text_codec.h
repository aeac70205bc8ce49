// A motion file's text byte for byte: its numbers as integers, predicted and range coded, and
// what surrounds them. Decoding uses integers alone. docs/format-texts.md describes the coded form.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "exact/damaged_text.h"

namespace reprise {

/// Codes any bytes. `known_text` is what the decoder has already: of a BVH the text before the
/// line MOTION. Coded numbers were decoded and compared; the result is never larger than the text
/// as a zstd frame of level 19.
std::vector<std::uint8_t> encode_text(std::string_view text, std::string_view known_text);

/// The bytes again, given the same `known_text`. Throws Error (damaged) for anything
/// that `encode_text` did not write, where it can be told, and for a text longer than `most`:
/// a few bytes can be any number of equal lines.
std::string decode_text(std::span<const std::uint8_t> coded, std::string_view known_text,
                        std::size_t most = TextLimits::bytes);

}  // namespace reprise
