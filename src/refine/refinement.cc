#include "refine/refinement.h"

#include <algorithm>
#include <cmath>

#include "refine/coded_channels.h"
#include "refine/refiner.h"

namespace reprise {

Refinement refine(const PreparedTake& prepared, const RefinementOptions& options) {
  return Refiner(prepared, options).run();
}

ChannelMatrix decode_refinement(const Skeleton& skeleton, const ChannelConstants& constants,
                                const TakeShape& shape, std::span<const std::uint8_t> bytes) {
  const CodedChannels coded = CodedChannels::decode(skeleton, constants, shape, bytes);
  ChannelMatrix channels = coded.trajectories(skeleton);
  coded.steady_feet(skeleton, channels);
  return channels;
}

}  // namespace reprise
