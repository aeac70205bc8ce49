#include "quant/take_codec.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "contacts/contact_stage.h"
#include "quant/catmull_rom.h"
#include "quant/contact_codec.h"
#include "quant/cosine_transform.h"
#include "quant/numbers.h"
#include "reprise/error.h"

namespace reprise {
namespace {

using Eigen::Index;

constexpr int step_bits = 9;

[[noreturn]] void throw_damaged() {
  throw Error(ErrorCode::damaged, "the motion of a take is not as it was written");
}

KnotShape shape_of(const CoefficientSpace& space, const TakeShape& take, bool tumbles,
                   CurveKinds curves) {
  const TrajectoryKinds kinds = trajectory_kinds(space, tumbles);
  KnotShape shape;
  shape.frames = take.frames;
  shape.trajectories = kinds.count();
  shape.root = kinds.root;
  shape.direct = kinds.direct;
  shape.levels = knot_levels(take.frame_rate, take.frames);
  shape.first_level = first_level_of(take.frame_rate);
  shape.frame_rate = take.frame_rate;
  shape.kind = curves.coefficients;
  shape.root_kind = curves.root;
  return shape;
}

/// Bits that say a driven joint or the root.
int joint_bits(const CoefficientSpace& space) {
  return static_cast<int>(std::bit_width(space.layout.driven.size()));
}

/// Quarter turns: mostly none or a half turn either way.
void encode_turn(RangeEncoder& encoder, std::int32_t turn) {
  const auto size = static_cast<std::uint32_t>(std::abs(std::int64_t{turn}));
  encoder.encode_plain(size != 0, 1);
  if (size == 0) return;
  encoder.encode_plain(turn < 0, 1);
  encoder.encode_plain(size != 2, 1);
  if (size == 2) return;
  encoder.encode_plain(size != 1, 1);
  if (size != 1) encode_number(encoder, size - 3);
}

std::int32_t decode_turn(RangeDecoder& decoder) {
  if (decoder.decode_plain(1) == 0) return 0;
  const bool negative = decoder.decode_plain(1) != 0;
  std::int64_t size = 2;
  if (decoder.decode_plain(1) != 0)
    size = decoder.decode_plain(1) == 0 ? 1 : std::int64_t{3} + decode_number(decoder);
  return static_cast<std::int32_t>(negative ? -size : size);
}

template <class Nested, class Cosines>
void transform(Eigen::MatrixXd& matrix, const KnotShape& shape, Nested&& nested,
               Cosines&& cosines) {
  for (const ColumnRun& run : column_runs(shape)) {
    Eigen::MatrixXd columns = matrix.middleCols(run.first, run.last - run.first);
    run.kind == CurveKind::cosines ? cosines(columns) : nested(columns, shape.levels);
    matrix.middleCols(run.first, run.last - run.first) = columns;
  }
}

}  // namespace

int half_octaves(int step_index) {
  constexpr int per_half_octave = QuantiserConstants::steps_per_octave / 2;
  return step_index / per_half_octave - QuantiserConstants::step_of_one_mm / per_half_octave;
}

double quantiser_step(int index) {
  return std::pow(2.0, static_cast<double>(index - QuantiserConstants::step_of_one_mm) /
                           QuantiserConstants::steps_per_octave);
}

int step_index_of(double millimetres) {
  const double octaves = std::log2(std::max(millimetres, 1e-6));
  return std::clamp(static_cast<int>(std::lround(QuantiserConstants::steps_per_octave * octaves)) +
                        QuantiserConstants::step_of_one_mm,
                    0, QuantiserConstants::most_step);
}

TakeKnots take_knots(const CoefficientSpace& space, const TakeShape& take, bool tumbles,
                     TrajectoryMatrix trajectories, CurveKinds kinds) {
  TakeKnots result{shape_of(space, take, tumbles, kinds), tumbles, std::move(trajectories)};
  transform(result.knots, result.shape, NestedKnots::from_frames, frames_to_cosines);
  return result;
}

std::vector<CurveKinds> possible_kinds(const KnotModel& model, long frames) {
  constexpr auto knots = CurveKind::nested_knots, cosines = CurveKind::cosines;
  const auto has = [&](CurveKind kind) { return model.kinds()[static_cast<std::size_t>(kind)]; };
  std::vector<CurveKinds> possible;
  if (has(knots)) possible.push_back({knots, knots});
  if (has(cosines) && frames <= most_cosine_frames) {
    possible.push_back({cosines, cosines});
    if (has(knots)) possible.push_back({cosines, knots});
  }
  if (possible.empty()) possible.push_back({knots, knots});
  return possible;
}

KnotModel::Choice quantise(const KnotModel& model, const TakeKnots& knots, int step_index) {
  KnotShape shape = knots.shape;
  shape.step_half_octaves = half_octaves(step_index);
  return KnotModel(model).choose(shape, knots.knots / quantiser_step(step_index),
                                 QuantiserConstants::lambda);
}

TrajectoryMatrix dequantise(const QuantisedKnots& quantised, const KnotShape& shape,
                            int step_index) {
  TrajectoryMatrix trajectories = quantised.cast<double>() * quantiser_step(step_index);
  transform(trajectories, shape, NestedKnots::to_frames, cosines_to_frames);
  return trajectories;
}

std::vector<std::uint8_t> encode_motion(const KnotModel& model, const CoefficientSpace& space,
                                        const TakeShape& take, const CodedMotion& motion) {
  RangeEncoder encoder;
  encoder.encode_plain(static_cast<std::uint32_t>(motion.step_index), step_bits);
  encoder.encode_plain(motion.tumbles, 1);
  encoder.encode_plain(static_cast<std::uint32_t>(motion.kinds.coefficients), 1);
  encoder.encode_plain(static_cast<std::uint32_t>(motion.kinds.root), 1);
  encode_number(encoder, static_cast<std::uint32_t>(motion.switches.size()));
  std::int32_t frame = 0;
  for (const BranchSwitch& branch : motion.switches) {
    encode_number(encoder, static_cast<std::uint32_t>(branch.frame - frame));
    encoder.encode_plain(static_cast<std::uint32_t>(branch.driven + 1), joint_bits(space));
    for (const std::int32_t turn : branch.quarter_turns) encode_turn(encoder, turn);
    frame = branch.frame;
  }
  KnotShape shape = shape_of(space, take, motion.tumbles, motion.kinds);
  shape.step_half_octaves = half_octaves(motion.step_index);
  KnotModel(model).encode(encoder, shape, motion.knots);
  const std::vector<Leg> legs = find_legs(space.layout.reference);
  encode_contacts(encoder, contact_shape(legs, take.frames, take.frame_rate), motion.contacts);
  return encoder.finish();
}

CodedMotion decode_motion(const KnotModel& model, const CoefficientSpace& space,
                          const TakeShape& take, std::span<const std::uint8_t> bytes) {
  RangeDecoder decoder(bytes);
  CodedMotion motion;
  motion.step_index = static_cast<int>(decoder.decode_plain(step_bits));
  motion.tumbles = decoder.decode_plain(1) != 0;
  motion.kinds.coefficients = static_cast<CurveKind>(decoder.decode_plain(1));
  motion.kinds.root = static_cast<CurveKind>(decoder.decode_plain(1));
  const bool cosines =
      motion.kinds.coefficients == CurveKind::cosines || motion.kinds.root == CurveKind::cosines;
  if (cosines && take.frames > most_cosine_frames) throw_damaged();
  const std::uint32_t switches = decode_number(decoder);
  std::int64_t frame = 0;
  for (std::uint32_t s = 0; s < switches; ++s) {
    frame += decode_number(decoder);
    const std::uint32_t driven = decoder.decode_plain(joint_bits(space));
    if (frame >= take.frames || driven > space.layout.driven.size() || decoder.ran_out()) {
      throw_damaged();
    }
    BranchSwitch branch{
        static_cast<std::int32_t>(frame), static_cast<std::int32_t>(driven) - 1, {}};
    for (std::int32_t& turn : branch.quarter_turns) turn = decode_turn(decoder);
    motion.switches.push_back(branch);
  }
  KnotShape shape = shape_of(space, take, motion.tumbles, motion.kinds);
  shape.step_half_octaves = half_octaves(motion.step_index);
  motion.knots = KnotModel(model).decode(decoder, shape);
  const std::vector<Leg> legs = find_legs(space.layout.reference);
  motion.contacts = decode_contacts(decoder, contact_shape(legs, take.frames, take.frame_rate));
  if (decoder.ran_out()) throw_damaged();
  return motion;
}

ChannelMatrix motion_channels(const CoefficientSpace& space, const Skeleton& skeleton,
                              const ChannelConstants& constants, const TakeShape& take,
                              const CodedMotion& motion) {
  const KnotShape shape = shape_of(space, take, motion.tumbles, motion.kinds);
  ChannelMatrix channels =
      to_channels(space, skeleton, motion.tumbles,
                  dequantise(motion.knots, shape, motion.step_index), motion.switches, constants);
  const std::vector<Leg> legs = find_legs(space.layout.reference);
  apply_contacts(skeleton, legs, take.frame_rate, motion.contacts, moving_channels(channels),
                 channels);
  return channels;
}

ChannelMatrix decode_take(const CodedSpace& coded, const Skeleton& skeleton,
                          const ChannelConstants& constants, const TakeShape& take,
                          std::span<const std::uint8_t> bytes) {
  return motion_channels(coded.space, skeleton, constants, take,
                         decode_motion(coded.model, coded.space, take, bytes));
}

}  // namespace reprise
