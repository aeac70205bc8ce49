#include "quant/trajectory_codec.h"

#include <algorithm>
#include <cmath>

#include "quant/coded_bits.h"
#include "quant/knot_contexts.h"
#include "quant/knot_walk.h"
#include "quant/numbers.h"
#include "quant/small_number.h"

namespace reprise {
namespace {

/// Few decisions are made of a take: weights have to move fast, and one set serves all slots.
constexpr Learning knot_learning = {30, 60, 65536 / 5};
constexpr Learning common_learning = {255, 6, 65536 / 5};

const BitMixer& fresh_mixer() {
  static const BitMixer fresh = [] {
    BitMixer mixer(KnotWalkConstants::table_sizes(), decision_count + 1, knot_learning);
    start_knot_counters(mixer);
    return mixer;
  }();
  return fresh;
}

constexpr std::uint32_t most_columns = 1u << 16;

/// A scale is likely to be that of the trajectory before, as the slot before differs there.
int expected_scale(const KnotScales& scales, std::size_t i) {
  const auto columns = static_cast<std::size_t>(scales.columns);
  const std::size_t slot = i / columns, column = i % columns;
  const int left = column > 0 ? scales.codes[i - 1] : 0;
  const bool first = slot == 0 || slot == KnotSlots::first_of(CurveKind::cosines);
  const int above = first ? left : scales.codes[i - columns];
  return column == 0 ? above : first ? left : (left + above) / 2;
}

/// Codes the scales of a kind with `code_bit`, each by what it differs from what is expected.
template <class CodeBit>
void code_scales(KnotScales& scales, CurveKind kind, CodeBit&& code_bit) {
  std::array<SmallNumber, 2> after_zero_or_not;
  int before = 0;
  const int first = KnotSlots::first_of(kind) * scales.columns;
  for (int i = first; i < first + KnotSlots::count_of(kind) * scales.columns; ++i) {
    const auto place = static_cast<std::size_t>(i);
    const int expected = expected_scale(scales, place);
    before = after_zero_or_not[before != 0].code(scales.codes[place] - expected, code_bit);
    scales.codes[place] = static_cast<std::int8_t>(
        std::clamp(expected + before, KnotScales::least, KnotScales::most));
  }
}

/// Learns from what it chooses on the way.
struct Chooser : BitLearner {
  const Eigen::MatrixXd& knots;
  double lambda;
  double wanted(Eigen::Index frame, int column) const {
    constexpr double most = 1 << 29;
    return std::clamp(knots(frame, column), -most, most);
  }
  double bits(const BitMixer::Contexts& contexts, bool bit) {
    return mixer.cost(contexts, bit) / 65536.0;
  }
};

}  // namespace

KnotModel::KnotModel(KnotScales scales) : scales_(std::move(scales)), mixer_(fresh_mixer()) {}

void KnotModel::learn_in_common() { mixer_.learn_as(common_learning); }

std::vector<std::uint8_t> KnotModel::prior(bool with_contexts) const {
  RangeEncoder encoder;
  encode_number(encoder, static_cast<std::uint32_t>(scales_.columns));
  for (int kind = 0; kind < curve_kinds; ++kind) {
    encoder.encode_plain(scales_.kinds[kind], 1);
    if (!scales_.kinds[kind]) continue;
    KnotScales scales = scales_;
    code_scales(scales, static_cast<CurveKind>(kind), [&](Probability one, bool bit) {
      encoder.encode(bit, one);
      return bit;
    });
  }
  encoder.encode_plain(with_contexts, 1);
  if (with_contexts) mixer_.save(encoder, fresh_mixer());
  return encoder.finish();
}

bool KnotModel::load_prior(std::span<const std::uint8_t> bytes) {
  RangeDecoder decoder(bytes);
  const std::uint32_t columns = decode_number(decoder);
  if (columns > most_columns) return false;
  scales_ = {};
  scales_.columns = static_cast<int>(columns);
  scales_.codes.assign(columns * KnotContexts::slots, KnotScales::least);
  for (int kind = 0; kind < curve_kinds; ++kind) {
    scales_.kinds[kind] = decoder.decode_plain(1) != 0;
    if (!scales_.kinds[kind]) continue;
    code_scales(scales_, static_cast<CurveKind>(kind),
                [&](Probability one, bool) { return !decoder.ran_out() && decoder.decode(one); });
  }
  if (decoder.decode_plain(1) != 0) mixer_.load(decoder);
  return !decoder.ran_out();
}

void KnotModel::encode(RangeEncoder& encoder, const KnotShape& shape, const QuantisedKnots& knots) {
  QuantisedKnots copy = knots;
  KnotWalk<BitWriter>({encoder, mixer_}, scales_, shape, copy).run();
}

QuantisedKnots KnotModel::decode(RangeDecoder& decoder, const KnotShape& shape) {
  QuantisedKnots knots = QuantisedKnots::Zero(shape.frames, shape.trajectories);
  KnotWalk<BitReader>({decoder, mixer_}, scales_, shape, knots).run();
  return knots;
}

double KnotModel::learn(const KnotShape& shape, const QuantisedKnots& knots) {
  QuantisedKnots copy = knots;
  std::uint64_t cost = 0;
  KnotWalk<BitLearner>({cost, mixer_}, scales_, shape, copy).run();
  return static_cast<double>(cost) / 65536.0;
}

KnotModel::Choice KnotModel::choose(const KnotShape& shape, const Eigen::MatrixXd& knots,
                                    double lambda) {
  // What the walk finds says up to which trajectory there are knots in a group.
  constexpr double dead_zone = 0.62;
  Choice choice;
  choice.knots = knots.unaryExpr([](double value) {
    const double size = std::floor(std::min(std::abs(value), double{1 << 29}) + 1.0 - dead_zone);
    return static_cast<std::int32_t>(value < 0 ? -size : size);
  });
  std::uint64_t bits = 0;
  KnotWalk<Chooser>({{bits, mixer_}, knots, lambda}, scales_, shape, choice.knots).run();
  choice.cost = (knots - choice.knots.cast<double>()).squaredNorm() / lambda +
                static_cast<double>(bits) / 65536.0;
  return choice;
}

}  // namespace reprise
