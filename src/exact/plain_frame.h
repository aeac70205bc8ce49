// zstd frames inside of coded texts.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reprise {

/// One frame of level 19 without magic number, size and checksum.
std::vector<std::uint8_t> compress_plain(std::string_view text);

/// At most about twice the size of such a frame, found much faster.
std::size_t rough_plain_size(std::string_view text);

/// Throws Error (damaged) for what is no frame, has bytes after it, or is larger than `most`.
std::string decompress_plain(std::span<const std::uint8_t> frame, std::size_t most);

}  // namespace reprise
