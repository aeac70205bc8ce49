// zstd frames, always with content size and checksum.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "store/archive_store.h"

namespace reprise {

/// Compresses at the highest ordinary level where `thorough`, else quickly. With a prefix, what
/// stands in it costs almost nothing; the same prefix is needed to get the bytes back.
Bytes compress(std::span<const std::uint8_t> bytes, bool thorough,
               std::span<const std::uint8_t> prefix = {});

/// Throws Error (damaged) for anything that `compress` did not write, and for content larger than
/// `most`.
Bytes decompress(std::span<const std::uint8_t> frame, std::size_t most,
                 std::span<const std::uint8_t> prefix = {});

inline std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace reprise
