#include "query/promise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/constant_channels.h"
#include "model/rotation_distance.h"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;

/// What rounding to decimals leaves of a value that does not change, in parts of the range up to
/// which a channel counts as constant.
constexpr double rounding_share = 0.1;

std::vector<Matrix3d> local_turns(const Take& take, Index f) {
  const std::span<const double> frame(take.channels.row(f).data(),
                                      static_cast<std::size_t>(take.channels.cols()));
  std::vector<Matrix3d> turns;
  for (const Joint& joint : take.skeleton->joints) turns.push_back(local_rotation(joint, frame));
  return turns;
}

/// Name of a channel that does not move in the source but in what was decoded; empty for none.
std::string moved_constant(const Take& original, const Take& decoded) {
  const Skeleton& skeleton = *original.skeleton;
  const ChannelConstants constants = find_constants(skeleton, original.channels);
  for (const Joint& joint : skeleton.joints) {
    for (std::size_t c = 0; c < joint.channels.size(); ++c) {
      const Index channel = joint.first_channel + static_cast<Index>(c);
      const auto& constant = constants[static_cast<std::size_t>(channel)];
      if (!constant) continue;
      const double range = is_rotation(joint.channels[c])
                               ? ConstantChannelLimits::range_degrees
                               : ConstantChannelLimits::range_mm / skeleton.millimetres_per_unit;
      const auto values = decoded.channels.col(channel).array();
      if ((values - *constant).abs().maxCoeff() > (1 + rounding_share) * range ||
          values.maxCoeff() - values.minCoeff() > rounding_share * range) {
        return joint.name;
      }
    }
  }
  return {};
}

}  // namespace

double greatest_pop(const Take& original, const Take& decoded) {
  double greatest = 0;
  for (Index f = 1; f < original.frames(); ++f) {
    const auto before = local_turns(original, f - 1), now = local_turns(original, f);
    const auto decoded_before = local_turns(decoded, f - 1), decoded_now = local_turns(decoded, f);
    for (std::size_t j = 0; j < now.size(); ++j) {
      greatest = std::max(greatest, degrees_between(decoded_before[j], decoded_now[j]) -
                                        degrees_between(before[j], now[j]));
    }
  }
  return greatest;
}

std::string broken_promise(const LayerRecord& layer, const Take& original, const Take& decoded,
                           const MotionErrors& errors) {
  const bool mean = layer.kind == LayerKind::coefficients || layer.kind == LayerKind::channels;
  const double measured = mean ? errors.places.mean : errors.places.max;
  if (!(measured <= layer.limit_mm)) {
    return fmt::format("its {} error is {:.4g} mm, more than the {:g} mm of its fidelity",
                       mean ? "mean" : "greatest", measured, layer.limit_mm);
  }
  if (layer.kind == LayerKind::refinement) {
    if (!(errors.turns.max <= layer.limit_deg)) {
      return fmt::format("a joint is turned by {:.4g} degrees, more than the {:g} of its fidelity",
                         errors.turns.max, layer.limit_deg);
    }
    const double pop = greatest_pop(original, decoded);
    if (!(pop <= layer.limit_deg)) {
      return fmt::format(
          "a joint turns by {:.4g} degrees more than its source from one frame to the next, more "
          "than the {:g} of its fidelity",
          pop, layer.limit_deg);
    }
  }
  const std::string moved = moved_constant(original, decoded);
  if (moved.empty()) return {};
  return fmt::format("a channel of joint '{}' moves that does not move in its source", moved);
}

}  // namespace reprise
