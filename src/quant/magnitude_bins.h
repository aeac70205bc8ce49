// How coders and their contexts part magnitudes into classes. All of this belongs to the archive
// format.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace reprise {

/// x 65536; half an octave.
constexpr std::uint32_t root_of_two = 92682;

constexpr std::uint32_t last_bucket = 59;  ///< of numbers below 2^30

/// Buckets 0, 1, 2, 3, 4-5, 6-7, 8-11, 12-15, ..: the first number of each, and its bits.
struct Bucket {
  std::uint32_t first;
  int bits;
};

constexpr Bucket bucket(std::uint32_t index) {
  if (index < 4) return {index, 0};
  const int bits = static_cast<int>(index - 2) / 2;
  return {(2u + (index & 1u)) << bits, bits};
}

constexpr std::uint32_t bucket_of(std::uint32_t magnitude) {
  if (magnitude < 4) return magnitude;
  const auto octave = static_cast<std::uint32_t>(std::bit_width(magnitude)) - 1;
  return 2 * octave + (magnitude >> (octave - 1) & 1);
}

static_assert(bucket_of(4) == 4 && bucket_of(6) == 5 && bucket_of(8) == 6 && bucket_of(12) == 7);
static_assert(bucket_of(bucket(17).first) == 17 && bucket_of(bucket(17).first - 1) == 16);
static_assert(bucket_of((1u << 30) - 1) == last_bucket);

/// Small numbers apart, large ones by their logarithm: 0 .. 7.
constexpr std::uint32_t magnitude_bin(std::int64_t magnitude) {
  if (magnitude < 4) return static_cast<std::uint32_t>(magnitude);
  return magnitude < 6 ? 4 : magnitude < 10 ? 5 : magnitude < 20 ? 6 : 7;
}

/// The same finer: 0 .. 23, from 12 on two an octave.
constexpr std::uint32_t fine_magnitude_bin(std::int64_t magnitude) {
  if (magnitude < 12) return static_cast<std::uint32_t>(magnitude);
  const int octave =
      static_cast<int>(std::bit_width(static_cast<std::uint64_t>(magnitude))) - 1;  // 12 has 3
  const auto half = static_cast<std::uint32_t>(magnitude >> (octave - 1) & 1);
  return std::min(12 + 2 * static_cast<std::uint32_t>(octave - 3) + half, 23u);
}

}  // namespace reprise
