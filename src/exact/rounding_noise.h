// Numbers next to zero that are what rounding left of an angle: whole multiples of a power of two,
// in radians, written in degrees. They take far fewer bits as multiples than as digits.
#pragma once

#include <cstdint>

#include "exact/number_format.h"

namespace reprise {

/// A multiple of 2^-62 radians.
constexpr std::uint32_t most_noise = (1u << 22) - 1;

/// What `CodedNumber::fine` of a general format is for a multiple (1 to `most_noise`) in degrees.
/// 0 where the number is not below the format's unit, or has more than nine digits.
std::uint64_t fine_of_noise(const NumberPrinter& printer, std::uint32_t multiple);

/// The multiple that has a number's `fine`, or 0 if none has.
std::uint32_t noise_of_fine(const NumberPrinter& printer, std::uint64_t fine);

}  // namespace reprise
