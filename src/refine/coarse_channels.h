// Layers of channels that bound the mean error of a take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "refine/refinement.h"

namespace reprise {

struct CoarseOptions {
  double mean_mm = 20;   ///< over all joints, end sites and frames
  bool contacts = true;  ///< feet are held where they stand
  /// Whoever has another coding of so many bytes wants no larger one.
  std::size_t most_bytes = 0;
};

/// Channels from the root outwards, as in a refinement, at a step that is the same for all frames
/// and joints: the coarsest that keeps the mean. It needs no axes, so that takes that are long and
/// unlike the others of their library are smaller so. `decode_coarse_channels` gives its `decoded`.
/// Nothing where it would be larger than `most_bytes`.
std::optional<Refinement> coarse_channels(const PreparedTake& prepared,
                                          const CoarseOptions& options);

/// Throws Error (damaged).
ChannelMatrix decode_coarse_channels(const Skeleton& skeleton, const ChannelConstants& constants,
                                     const TakeShape& shape, std::span<const std::uint8_t> bytes);

}  // namespace reprise
