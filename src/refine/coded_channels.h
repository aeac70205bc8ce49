// What a refinement's bytes say: channels as rounded knots.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "refine/channel_coder.h"
#include "refine/step_grid.h"
#include "reprise/model/take.h"

namespace reprise {

struct CodedChannels {
  CodedChannels(const Skeleton& skeleton, const TakeShape& take);

  /// Frames of the channel at a place of the coding order, decoded.
  Eigen::VectorXd trajectory(std::size_t place) const;
  ChannelMatrix channels(const Skeleton& skeleton) const;
  std::vector<std::uint8_t> encode() const;
  /// Throws Error (damaged).
  void decode(std::span<const std::uint8_t> bytes);

  ChannelKnotShape shape;
  StepGrid steps;
  ChannelKnots knots;      ///< the coarsest ones are differences from the one before
  Eigen::MatrixXd stored;  ///< columns of the channels that are stored as they are
};

}  // namespace reprise
