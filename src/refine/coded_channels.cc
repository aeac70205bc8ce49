#include "refine/coded_channels.h"

#include <bit>
#include <cmath>

#include "quant/catmull_rom.h"
#include "refine/pose_metric.h"
#include "reprise/error.h"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr std::size_t most_bytes_past_end = 16;

[[noreturn]] void throw_damaged() {
  throw Error(ErrorCode::damaged, "the motion of a take is not as it was written");
}

}  // namespace

CodedChannels::CodedChannels(const Skeleton& skeleton, const TakeShape& take)
    : shape{take.frames, knot_levels(take.frame_rate, take.frames), first_level_of(take.frame_rate),
            coding_parents(skeleton)},
      steps(skeleton, take.frames, shape.levels),
      knots(ChannelKnots::Zero(take.frames, static_cast<Index>(shape.parents.size()))),
      stored(take.frames, 0) {}

Eigen::VectorXd CodedChannels::trajectory(std::size_t place) const {
  const auto column = static_cast<Index>(place);
  if (steps.base[place] < 0) return stored.col(column);
  MatrixXd values(shape.frames, 1);
  double coarsest = 0;
  for (Index f = 0; f < shape.frames; ++f) {
    const double value = knots(f, column) * steps.step(place, f);
    const bool follows = knot_level(f, shape.levels) == shape.levels;
    values(f, 0) = follows ? coarsest += value : value;
  }
  NestedKnots::to_frames(values, shape.levels);
  return values.col(0);
}

ChannelMatrix CodedChannels::channels(const Skeleton& skeleton) const {
  ChannelMatrix result(shape.frames, skeleton.channel_count);
  const std::vector<int> order = coding_order(skeleton);
  for (std::size_t i = 0; i < order.size(); ++i) result.col(order[i]) = trajectory(i);
  return result;
}

std::vector<std::uint8_t> CodedChannels::encode() const {
  RangeEncoder encoder;
  steps.encode(encoder);
  for (std::size_t i = 0; i < steps.base.size(); ++i) {
    if (steps.base[i] >= 0) continue;
    for (Index f = 0; f < shape.frames; ++f) {
      const auto bits = std::bit_cast<std::uint64_t>(stored(f, static_cast<Index>(i)));
      encoder.encode_plain(static_cast<std::uint32_t>(bits >> 32), 32);
      encoder.encode_plain(static_cast<std::uint32_t>(bits), 32);
    }
  }
  ChannelCoder().encode(encoder, shape, steps, knots);
  return encoder.finish();
}

void CodedChannels::decode(std::span<const std::uint8_t> bytes) {
  RangeDecoder decoder(bytes);
  if (!steps.decode(decoder)) throw_damaged();
  for (std::size_t i = 0; i < steps.base.size(); ++i) {
    if (steps.base[i] >= 0) continue;
    if (decoder.bytes_past_end() > most_bytes_past_end) throw_damaged();
    if (stored.cols() == 0) stored = MatrixXd::Zero(shape.frames, knots.cols());
    for (Index f = 0; f < shape.frames; ++f) {
      const std::uint64_t high = decoder.decode_plain(32);
      const auto value = std::bit_cast<double>(high << 32 | decoder.decode_plain(32));
      if (!std::isfinite(value)) throw_damaged();
      stored(f, static_cast<Index>(i)) = value;
    }
  }
  knots = ChannelCoder().decode(decoder, shape, steps);
  if (decoder.bytes_past_end() > most_bytes_past_end) throw_damaged();
}

}  // namespace reprise
