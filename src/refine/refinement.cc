#include "refine/refinement.h"

#include <algorithm>
#include <cmath>

#include "refine/coded_channels.h"
#include "refine/refiner.h"

namespace reprise {

Refinement refine(const Take& take, const ChannelMatrix*, double bound_mm, const RefinementModel&) {
  return Refiner(take, bound_mm).run();
}

ChannelMatrix decode_refinement(const Skeleton& skeleton, const TakeShape& shape,
                                const ChannelMatrix*, std::span<const std::uint8_t> bytes,
                                const RefinementModel&) {
  return CodedChannels::decode(skeleton, shape, bytes).channels(skeleton);
}

}  // namespace reprise
