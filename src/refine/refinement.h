// Layers of a take that bound its worst joint in its worst frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "quant/take_codec.h"
#include "reprise/model/take.h"

namespace reprise {

struct Refinement {
  std::vector<std::uint8_t> bytes;
  ChannelMatrix decoded;          ///< what a decoder makes of them
  double max_mm = 0;              ///< largest distance of any joint or end site from the source
  std::size_t contact_bytes = 0;  ///< those of `bytes` that say when feet stand
};

struct RefinementOptions {
  double bound_mm = 10;  ///< 0.05 to 100
  bool contacts = true;  ///< feet are held where they stand
};

/// A layer from which no joint or end site in any frame comes out further than `bound_mm` from the
/// take, after forward kinematics in double precision, and after the channels are written with six
/// decimals. Channels are finite; always succeeds. Feet slide about as much as the take's own (foot
/// skate, docs/measures.md), if contacts are held and the bound lets them. It does not start
/// from a layer below: the way from markers to angles may take another branch on another machine,
/// and a bound must not depend on it.
Refinement refine(const Take& take, const RefinementOptions& options);

/// What `refine` says in its bytes. Throws Error (damaged).
ChannelMatrix decode_refinement(const Skeleton& skeleton, const TakeShape& shape,
                                std::span<const std::uint8_t> bytes);

}  // namespace reprise
