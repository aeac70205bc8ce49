// Quantised knots of channels to bytes and back, channel after channel.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "quant/bit_model.h"
#include "quant/range_coder.h"
#include "refine/step_grid.h"

namespace reprise {

/// Numbers of a channel at the places of NestedKnots, one column a channel in coding order.
using ChannelKnots = Eigen::Matrix<std::int32_t, Eigen::Dynamic, Eigen::Dynamic>;

/// Beyond this a channel is stored as it is.
constexpr std::int32_t most_knot = 1 << 28;

struct ChannelKnotShape {
  long frames = 0;
  int levels = 0;
  int first_level = 0;       ///< as in KnotShape
  std::vector<int> parents;  ///< coding_parents: the channel whose knots say most of a channel's
};

class ChannelCoder {
 public:
  ChannelCoder();

  void encode(RangeEncoder& encoder, const ChannelKnotShape& shape, const StepGrid& steps,
              ChannelKnots knots);
  /// Whatever the bytes are, gives some knots.
  ChannelKnots decode(RangeDecoder& decoder, const ChannelKnotShape& shape, const StepGrid& steps);

  /// Learns as if the knots had been coded; returns what they would cost, in bits.
  double learn(const ChannelKnotShape& shape, const StepGrid& steps, ChannelKnots knots);

 private:
  BitMixer mixer_;
};

}  // namespace reprise
