#include "refine/refinement.h"

#include <algorithm>
#include <cmath>

#include "refine/coded_channels.h"
#include "refine/refiner.h"

namespace reprise {

Refinement refine(const Take& take, double bound_mm) { return Refiner(take, bound_mm).run(); }

ChannelMatrix decode_refinement(const Skeleton& skeleton, const TakeShape& shape,
                                std::span<const std::uint8_t> bytes) {
  return CodedChannels::decode(skeleton, shape, bytes).channels(skeleton);
}

}  // namespace reprise
