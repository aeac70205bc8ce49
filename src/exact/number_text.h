// The part of a text that is frames of numbers: the numbers as integers, predicted and range coded,
// and what surrounds them. docs/format-texts.md describes the coded form.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reprise {

/// Nothing, where the text has no frames of numbers. `known_text` is what the decoder has already:
/// position channels are expected to start with the offsets that it gives.
std::optional<std::vector<std::uint8_t>> encode_number_text(std::string_view text,
                                                            std::string_view known_text);

/// Appends what was coded to `text`. Throws Error (damaged) for anything that `encode_number_text`
/// did not write, where it can be told, and where `text` gets longer than `most`.
void decode_number_text(std::span<const std::uint8_t> coded, std::string_view known_text,
                        std::size_t most, std::string& text);

}  // namespace reprise
