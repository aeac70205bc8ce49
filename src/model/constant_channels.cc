#include "model/constant_channels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reprise {
namespace {

using Limits = ConstantChannelLimits;

constexpr std::array<double, 10> powers_of_ten = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
/// Whole numbers up to here are doubles.
constexpr double most_whole = 9007199254740992.0;

}  // namespace

double rounded_to_decimals(double value, int decimals) {
  const double scale = powers_of_ten[static_cast<std::size_t>(decimals)];
  const double whole = std::round(value * scale);
  // A whole number over a power of ten is the double nearest to that decimal number.
  return std::abs(whole) < most_whole ? whole / scale : value;
}

ChannelConstants find_constants(const Skeleton& skeleton, const ChannelMatrix& channels) {
  ChannelConstants constants(static_cast<std::size_t>(skeleton.channel_count));
  if (channels.rows() == 0) return constants;
  const Eigen::RowVectorXd low = channels.colwise().minCoeff();
  const Eigen::RowVectorXd high = channels.colwise().maxCoeff();
  for (const Joint& joint : skeleton.joints) {
    for (std::size_t c = 0; c < joint.channels.size(); ++c) {
      const auto channel = joint.first_channel + static_cast<Eigen::Index>(c);
      const double least = is_rotation(joint.channels[c])
                               ? Limits::range_degrees
                               : Limits::range_mm / skeleton.millimetres_per_unit;
      const double range = high[channel] - low[channel];
      if (range > 0 && !(range < least)) continue;
      constants[static_cast<std::size_t>(channel)] =
          rounded_to_decimals(low[channel] + range / 2, Limits::decimals);
    }
  }
  return constants;
}

std::vector<bool> moving_channels(const ChannelConstants& constants) {
  std::vector<bool> moves;
  for (const auto& constant : constants) moves.push_back(!constant.has_value());
  return moves;
}

std::size_t moving_count(const ChannelConstants& constants) {
  return static_cast<std::size_t>(
      std::ranges::count_if(constants, [](const auto& constant) { return !constant; }));
}

void set_constants(const ChannelConstants& constants, ChannelMatrix& channels) {
  for (std::size_t c = 0; c < constants.size(); ++c) {
    if (constants[c]) channels.col(static_cast<Eigen::Index>(c)).setConstant(*constants[c]);
  }
}

}  // namespace reprise
