// Layers of a take that bound its worst joint in its worst frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "quant/take_codec.h"
#include "quant/take_header.h"
#include "reprise/model/take.h"

namespace reprise {

struct Refinement {
  std::vector<std::uint8_t> bytes;
  ChannelMatrix decoded;          ///< of the prepared take: what a decoder makes of them
  std::size_t contact_bytes = 0;  ///< those of `bytes` that say when feet stand
};

struct RefinementOptions {
  double bound_mm = 10;   ///< 0.05 to 100
  double bound_deg = 10;  ///< 0.05 to 180
  bool contacts = true;   ///< feet are held where they stand
};

/// A layer from which no joint or end site in any frame comes out further than `bound_mm` from its
/// place in the take, or turned by more than `bound_deg` from its world orientation, and no joint
/// turns against its parent by more than `bound_deg` beyond the source from one frame to the next;
/// after forward kinematics in double precision, and after the channels are written with six
/// decimals. Channels that do not move come out as they are. Channels are finite; always succeeds.
/// Feet slide about as much as the take's own (foot skate, docs/measures.md), if contacts are held
/// and the bound lets them. It does not start from a layer below: the way from markers to angles
/// may take another branch on another machine, and a bound must not depend on it.
Refinement refine(const PreparedTake& prepared, const RefinementOptions& options);

/// What `refine` says in its bytes: channels of the prepared take, whose frames `shape` has. Throws
/// Error (damaged).
ChannelMatrix decode_refinement(const Skeleton& skeleton, const ChannelConstants& constants,
                                const TakeShape& shape, std::span<const std::uint8_t> bytes);

}  // namespace reprise
