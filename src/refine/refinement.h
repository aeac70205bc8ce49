// Layers of a take that bound its worst joint in its worst frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "quant/take_codec.h"
#include "reprise/model/take.h"

namespace reprise {

/// What the takes of one skeleton have in common. Empty yet: contexts that were learned from other
/// takes took only 1 to 5 % off (docs/findings/2026-11-25-bounded-coder.md).
struct RefinementModel {};

struct Refinement {
  std::vector<std::uint8_t> bytes;
  ChannelMatrix decoded;  ///< what `decode_refinement` gives
  double max_mm = 0;      ///< largest distance of any joint or end site from the source
};

/// A layer that brings `lower` (channels as the layer below decodes them, or null for none) within
/// `bound_mm` of the take: no joint or end site in any frame is further off after forward
/// kinematics in double precision, and after the channels are written with six decimals.
/// `bound_mm` is 0.05 to 100, channels are finite; always succeeds. `lower` and `model` are not
/// looked at: the way from markers to angles may take another branch on another machine, and a
/// bound must not depend on it.
Refinement refine(const Take& take, const ChannelMatrix* lower, double bound_mm,
                  const RefinementModel& model);

/// Throws Error (damaged).
ChannelMatrix decode_refinement(const Skeleton& skeleton, const TakeShape& shape,
                                const ChannelMatrix* lower, std::span<const std::uint8_t> bytes,
                                const RefinementModel& model);

}  // namespace reprise
