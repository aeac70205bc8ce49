// A motion file's text as bytes and back, byte for byte.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reprise {

/// `known_text` is what the decoder has already (BVH: the text before the line MOTION).
std::vector<std::uint8_t> encode_text(std::string_view text, std::string_view known_text);

/// Throws Error (damaged).
std::string decode_text(std::span<const std::uint8_t> coded, std::string_view known_text);

}  // namespace reprise
