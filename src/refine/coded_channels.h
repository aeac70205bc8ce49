// What a refinement's bytes say: channels as rounded knots, and when feet stand.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "contacts/contact_detection.h"
#include "model/constant_channels.h"
#include "refine/channel_coder.h"
#include "refine/coding_order.h"
#include "refine/step_grid.h"
#include "reprise/model/take.h"

namespace reprise {

/// How far apart the coarsest knots are, and how long steps stay the same: 2^n frames.
struct TimeScales {
  static constexpr int bits = 4;
  static constexpr int most = 8;  ///< of NestedKnots
  int levels = 0;
  int block_levels = 0;
  bool operator==(const TimeScales&) const = default;
};

/// Coarsest knots about `seconds` apart, and at least two of them where there are two frames.
TimeScales time_scales(const TakeShape& take, double seconds);

/// Whether so many coded bytes can hold so many frames of so many channels that move: each knot is
/// a decision, and what is stored as it is takes more. What an encoder leaves out at the end
/// counts, too.
bool channels_fit(std::size_t bytes, std::size_t moving_channels, long frames);

struct CodedChannels {
  /// Channels that do not move (`constants`) are not coded.
  CodedChannels(const Skeleton& skeleton, const ChannelConstants& constants, const TakeShape& take,
                TimeScales scales);
  /// Throws Error (damaged).
  static CodedChannels decode(const Skeleton& skeleton, const ChannelConstants& constants,
                              const TakeShape& take, std::span<const std::uint8_t> bytes);

  /// Frames of the channel at a place of the coding order, decoded; contacts change it yet.
  Eigen::VectorXd trajectory(std::size_t place) const;
  /// All of them.
  ChannelMatrix trajectories(const Skeleton& skeleton) const;
  /// The last step of decoding, where a bound holds: feet move as steadily as the source's while
  /// they stand in `contacts`.
  void steady_feet(const Skeleton& skeleton, ChannelMatrix& channels) const;
  /// The last step of decoding, where just a mean holds: feet are put where they stand.
  void hold_feet(const Skeleton& skeleton, ChannelMatrix& channels) const;
  /// One a channel of a frame: its numbers say more than one value for all frames. Contacts turn no
  /// others.
  std::vector<bool> turning_channels() const;
  std::vector<std::uint8_t> encode() const;
  /// About as many bytes as contacts take up of those of `encode`.
  std::size_t contact_bytes() const;

  ChannelConstants constants;
  CodingOrder order;
  TimeScales scales;
  double frame_rate;
  std::vector<Leg> legs;
  ChannelKnotShape shape;
  StepGrid steps;
  ChannelKnots knots;      ///< the coarsest ones are differences from the one before
  Eigen::MatrixXd stored;  ///< columns of the channels that are stored as they are
  TakeContacts contacts;   ///< of `legs`
};

}  // namespace reprise
