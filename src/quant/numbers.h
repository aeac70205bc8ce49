// Numbers among the bits of a range coder: how many bits they have, then the bits.
#pragma once

#include <bit>
#include <cstdint>

#include "quant/range_coder.h"

namespace reprise {

/// Small numbers are short: n takes about 2 log2(n + 1) + 1 bits.
inline void encode_number(RangeEncoder& encoder, std::uint32_t value) {
  const std::uint64_t plus_one = std::uint64_t{value} + 1;
  const auto width = static_cast<int>(std::bit_width(plus_one));
  encoder.encode_plain(0, width - 1);
  encoder.encode_plain(1, 1);
  encoder.encode_plain(static_cast<std::uint32_t>(plus_one), width - 1);
}

inline std::uint32_t decode_number(RangeDecoder& decoder) {
  int width = 0;
  while (decoder.decode_plain(1) == 0) {
    // No number has more bits; only a damaged stream says so.
    if (++width > 32) return 0;
  }
  const std::uint64_t plus_one = (std::uint64_t{1} << width) | decoder.decode_plain(width);
  return static_cast<std::uint32_t>(plus_one - 1);
}

inline void encode_signed(RangeEncoder& encoder, std::int32_t value) {
  const std::int64_t wide = value;
  encode_number(encoder, static_cast<std::uint32_t>(wide < 0 ? -2 * wide - 1 : 2 * wide));
}

inline std::int32_t decode_signed(RangeDecoder& decoder) {
  const std::int64_t value = decode_number(decoder);
  return static_cast<std::int32_t>(value & 1 ? -(value + 1) / 2 : value / 2);
}

}  // namespace reprise
