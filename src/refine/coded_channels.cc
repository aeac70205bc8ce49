#include "refine/coded_channels.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "contacts/contact_stage.h"
#include "quant/bit_model.h"
#include "quant/catmull_rom.h"
#include "quant/contact_codec.h"
#include "reprise/error.h"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

[[noreturn]] void throw_damaged() {
  throw Error(ErrorCode::damaged, "the motion of a take is not as it was written");
}

}  // namespace

bool channels_fit(std::size_t bytes, std::size_t moving_channels, long frames) {
  constexpr std::size_t most_left_out = 32;
  const std::size_t decisions = (bytes + most_left_out) * most_decisions_per_byte;
  return moving_channels == 0 || static_cast<std::size_t>(frames) <= decisions / moving_channels;
}

TimeScales time_scales(const TakeShape& take, double seconds) {
  const double apart = std::max(1.0, seconds * take.frame_rate);
  int levels = std::clamp(static_cast<int>(std::lround(std::log2(apart))), 0, TimeScales::most);
  while (levels > 0 && (Index{1} << levels) >= take.frames) --levels;
  return {levels, std::max(0, levels - 1)};
}

CodedChannels::CodedChannels(const Skeleton& skeleton, const ChannelConstants& still,
                             const TakeShape& take, TimeScales time)
    : constants(still),
      order(skeleton, moving_channels(still)),
      scales(time),
      frame_rate(take.frame_rate),
      legs(find_legs(skeleton)),
      shape{take.frames, time.levels, first_level_of(take.frame_rate), order.parents},
      steps(skeleton, order, take.frames, time.block_levels),
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

ChannelMatrix CodedChannels::trajectories(const Skeleton& skeleton) const {
  ChannelMatrix result(shape.frames, skeleton.channel_count);
  for (std::size_t i = 0; i < order.size(); ++i) result.col(order.channels[i]) = trajectory(i);
  set_constants(constants, result);
  return result;
}

void CodedChannels::steady_feet(const Skeleton& skeleton, ChannelMatrix& channels) const {
  if (contacts.intervals.empty()) return;
  steady_contacts(skeleton, legs, frame_rate, contacts, turning_channels(), channels);
}

void CodedChannels::hold_feet(const Skeleton& skeleton, ChannelMatrix& channels) const {
  if (contacts.intervals.empty()) return;
  apply_contacts(skeleton, legs, frame_rate, contacts, turning_channels(), channels);
}

std::vector<bool> CodedChannels::turning_channels() const {
  // By what is stored, since decoded numbers that are meant to be the same may not be.
  std::vector<bool> moves(constants.size(), false);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto column = static_cast<Index>(i);
    moves[static_cast<std::size_t>(order.channels[i])] =
        steps.base[i] < 0 ? (stored.col(column).array() != stored(0, column)).any()
                          : (knots.col(column).tail(shape.frames - 1).array() != 0).any();
  }
  return moves;
}

std::vector<std::uint8_t> CodedChannels::encode() const {
  RangeEncoder encoder;
  encoder.encode_plain(static_cast<std::uint32_t>(scales.levels), TimeScales::bits);
  encoder.encode_plain(static_cast<std::uint32_t>(scales.block_levels), TimeScales::bits);
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
  encode_contacts(encoder, contact_shape(legs, shape.frames, frame_rate), contacts);
  return encoder.finish();
}

std::size_t CodedChannels::contact_bytes() const {
  if (contacts.intervals.empty()) return 0;
  RangeEncoder encoder;
  encode_contacts(encoder, contact_shape(legs, shape.frames, frame_rate), contacts);
  return encoder.finish().size();
}

CodedChannels CodedChannels::decode(const Skeleton& skeleton, const ChannelConstants& constants,
                                    const TakeShape& take, std::span<const std::uint8_t> bytes) {
  // The number of frames is the row's; it decides how much memory is taken.
  if (!channels_fit(bytes.size(), moving_count(constants), take.frames)) throw_damaged();
  RangeDecoder decoder(bytes);
  TimeScales time;
  time.levels = static_cast<int>(decoder.decode_plain(TimeScales::bits));
  time.block_levels = static_cast<int>(decoder.decode_plain(TimeScales::bits));
  if (time.levels > TimeScales::most || time.block_levels > TimeScales::most) throw_damaged();
  if (time.levels > 0 && (Index{1} << time.levels) >= take.frames) throw_damaged();
  CodedChannels coded(skeleton, constants, take, time);
  if (!coded.steps.decode(decoder)) throw_damaged();
  const ChannelKnotShape& shape = coded.shape;
  for (std::size_t i = 0; i < coded.steps.base.size(); ++i) {
    if (coded.steps.base[i] >= 0) continue;
    if (decoder.ran_out()) throw_damaged();
    if (coded.stored.cols() == 0) coded.stored = MatrixXd::Zero(shape.frames, coded.knots.cols());
    for (Index f = 0; f < shape.frames; ++f) {
      const std::uint64_t high = decoder.decode_plain(32);
      const auto value = std::bit_cast<double>(high << 32 | decoder.decode_plain(32));
      if (!std::isfinite(value)) throw_damaged();
      coded.stored(f, static_cast<Index>(i)) = value;
    }
  }
  coded.knots = ChannelCoder().decode(decoder, shape, coded.steps);
  if (decoder.ran_out()) throw_damaged();
  coded.contacts =
      decode_contacts(decoder, contact_shape(coded.legs, shape.frames, coded.frame_rate));
  if (decoder.ran_out()) throw_damaged();
  return coded;
}

}  // namespace reprise
