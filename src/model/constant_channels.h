// Channels that do not move, and what they are: they come out as they went in, at every fidelity.
#pragma once

#include <optional>
#include <vector>

#include "reprise/model/take.h"

namespace reprise {

/// A channel whose range over a take is below this does not move.
struct ConstantChannelLimits {
  static constexpr double range_mm = 0.001;
  static constexpr double range_degrees = 0.0001;
  /// A constant value is kept to this many decimals of a degree or of the file's unit.
  static constexpr int decimals = 9;
};

/// Of each channel: its value where it does not move, nothing where it does. A range that is not
/// quite zero gives its middle. Without frames every channel moves.
using ChannelConstants = std::vector<std::optional<double>>;
ChannelConstants find_constants(const Skeleton& skeleton, const ChannelMatrix& channels);

/// One a channel: it moves.
std::vector<bool> moving_channels(const ChannelConstants& constants);

/// How many channels move.
std::size_t moving_count(const ChannelConstants& constants);

/// Sets the channels that do not move to their values.
void set_constants(const ChannelConstants& constants, ChannelMatrix& channels);

/// The nearest number with so many decimals of those that a double can say exactly; numbers too
/// large to have any stay as they are.
double rounded_to_decimals(double value, int decimals);

}  // namespace reprise
