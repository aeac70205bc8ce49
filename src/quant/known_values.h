// Values that channels of a skeleton often have where they do not move, as bytes and back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ingest/trajectories.h"

namespace reprise {

/// Empty where no channel has any.
std::vector<std::uint8_t> encode_known_values(const KnownValues& known);
/// A list for each channel. Throws Error (damaged).
KnownValues decode_known_values(std::span<const std::uint8_t> bytes, std::size_t channels);

}  // namespace reprise
