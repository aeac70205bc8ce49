#include "quant/trajectory_codec.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "quant/catmull_rom.h"
#include "quant/numbers.h"
#include "quant/small_number.h"

namespace reprise {
namespace {

struct Knots {
  KnotShape shape;
  QuantisedKnots values;
};

/// Knots that are mostly zero where levels are fine and trajectories late, and sometimes very
/// large.
Knots random_knots(long frames, int root, int axes, int direct, unsigned seed,
                   CurveKind kind = CurveKind::nested_knots,
                   CurveKind root_kind = CurveKind::nested_knots) {
  std::mt19937 random(seed);
  Knots knots;
  knots.shape = {
      frames,   root + axes + direct, root, direct, knot_levels(120, frames), 0, 10, 120, kind,
      root_kind};
  knots.values = QuantisedKnots::Zero(frames, knots.shape.trajectories);
  for (long f = 0; f < frames; ++f) {
    const int level = knot_level(f, knots.shape.levels);
    for (int c = 0; c < knots.shape.trajectories; ++c) {
      if (static_cast<int>(random() % 12) > level + 2 || random() % 40 < static_cast<unsigned>(c))
        continue;
      const int largest = random() % 50 == 0 ? 1 << 28 : 6;
      knots.values(f, c) = static_cast<int>(random() % (2u * largest)) - largest;
    }
  }
  return knots;
}

TEST(KnotModel, KnotsComeBack) {
  unsigned seed = 1;
  for (const long frames : {1L, 2L, 3L, 17L, 64L, 65L, 1000L}) {
    for (const auto& [root, axes, direct] :
         {std::array{0, 0, 1}, std::array{4, 1, 0}, std::array{4, 40, 66}, std::array{7, 90, 3}}) {
      for (int pair = 0; pair < curve_kinds * curve_kinds; ++pair) {
        const Knots knots = random_knots(frames, root, axes, direct, ++seed,
                                         static_cast<CurveKind>(pair % curve_kinds),
                                         static_cast<CurveKind>(pair / curve_kinds));
        RangeEncoder encoder;
        KnotModel().encode(encoder, knots.shape, knots.values);
        const auto bytes = encoder.finish();
        RangeDecoder decoder(bytes);
        ASSERT_EQ(KnotModel().decode(decoder, knots.shape), knots.values) << frames << " " << axes;
        EXPECT_LE(decoder.bytes_past_end(), 8u);
      }
    }
  }
}

TEST(KnotModel, EmptyKnotsCostNextToNothing) {
  Knots knots = random_knots(5000, 4, 40, 20, 3);
  knots.values.setZero();
  RangeEncoder encoder;
  KnotModel().encode(encoder, knots.shape, knots.values);
  EXPECT_LT(encoder.finish().size(), 16u);
}

TEST(KnotModel, PriorHelpsAndIsReadAsWritten) {
  KnotScales scales;
  std::vector<Knots> takes;
  for (unsigned seed = 10; seed < 16; ++seed) {
    takes.push_back(random_knots(400, 4, 30, 2, seed));
    scales.add(takes.back().shape, takes.back().values.cast<double>() * 32.0);
  }
  scales.settle();
  KnotModel learned(scales);
  for (const Knots& take : takes) learned.learn(take.shape, take.values);
  const auto prior = learned.prior(true);
  KnotModel with, without;
  ASSERT_TRUE(with.load_prior(prior));
  ASSERT_TRUE(without.load_prior(learned.prior(false)));
  const Knots other = random_knots(400, 4, 30, 2, 99);
  EXPECT_LT(KnotModel(with).learn(other.shape, other.values),
            KnotModel(without).learn(other.shape, other.values));
  RangeEncoder encoder;
  KnotModel(with).encode(encoder, other.shape, other.values);
  const auto bytes = encoder.finish();
  KnotModel reader;
  ASSERT_TRUE(reader.load_prior(prior));
  RangeDecoder decoder(bytes);
  EXPECT_EQ(reader.decode(decoder, other.shape), other.values);
}

TEST(KnotModel, ChosenKnotsAreWorthTheirError) {
  std::mt19937 random(8);
  std::normal_distribution<double> normal;
  const KnotShape shape = random_knots(600, 4, 20, 1, 1).shape;
  Eigen::MatrixXd wanted(600, 25);
  for (long f = 0; f < wanted.rows(); ++f) {
    for (int c = 0; c < wanted.cols(); ++c) {
      wanted(f, c) = normal(random) * (1 + knot_level(f, shape.levels)) * 8.0 / (8 + c);
    }
  }
  const double lambda = 0.1;
  const auto total = [&](const QuantisedKnots& knots) {
    return (wanted - knots.cast<double>()).squaredNorm() + lambda * KnotModel().learn(shape, knots);
  };
  const QuantisedKnots chosen = KnotModel().choose(shape, wanted, lambda).knots;
  const QuantisedKnots rounded = wanted.array().round().cast<std::int32_t>();
  EXPECT_LT(total(chosen), total(rounded));
  EXPECT_LT(KnotModel().learn(shape, chosen), KnotModel().learn(shape, rounded));
  // Which trajectory is the last one of a level is decided before, so a little is lost there.
  EXPECT_NEAR(KnotModel().choose(shape, wanted, lambda).cost, total(chosen) / lambda,
              0.02 * total(chosen) / lambda);
  // Nothing is made larger than it is.
  EXPECT_LE((chosen.cast<double>().cwiseAbs() - wanted.cwiseAbs()).maxCoeff(), 0.5 + 1e-9);
}

TEST(KnotModel, GarbageIsReadWithoutHarm) {
  std::mt19937 random(4);
  for (int i = 0; i < 200; ++i) {
    std::vector<std::uint8_t> bytes(random() % 200);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    const auto kind = static_cast<CurveKind>(i % curve_kinds);
    const KnotShape shape = random_knots(100, 4, 20, 2, 7, kind, kind).shape;
    RangeDecoder decoder(bytes);
    const QuantisedKnots knots = KnotModel().decode(decoder, shape);
    EXPECT_EQ(knots.rows(), 100);
    KnotModel model;
    model.load_prior(bytes);
    RangeDecoder again(bytes);
    model.decode(again, shape);
  }
}

TEST(KnotModel, KnotsOfEverySizeComeBack) {
  // Each differs from the one before it by what a number may be at most, down to the least integer.
  constexpr std::int32_t step = 1 << 30, least = std::numeric_limits<std::int32_t>::min();
  Knots knots;
  knots.shape = {4, 1, 1, 0, 0, 0, 10, 120};
  knots.values.resize(4, 1);
  knots.values << -step, least, least, -step;
  RangeEncoder encoder;
  KnotModel().encode(encoder, knots.shape, knots.values);
  const auto bytes = encoder.finish();
  RangeDecoder decoder(bytes);
  EXPECT_EQ(KnotModel().decode(decoder, knots.shape), knots.values);
}

TEST(KnotModel, BytesThatEndEndTheKnots) {
  const KnotShape shape{10000, 4, 4, 0, 0, 0, 10, 120};
  RangeDecoder decoder({});
  const QuantisedKnots knots = KnotModel().decode(decoder, shape);
  EXPECT_TRUE(decoder.ran_out());
  EXPECT_TRUE((knots.bottomRows(9000).array() == 0).all()) << "read from nowhere";
}

TEST(KnotModel, ScalesBeyondTheirLimitsAreCut) {
  RangeEncoder encoder;
  encode_number(encoder, 1);
  encoder.encode_plain(1, 1);
  std::array<SmallNumber, 2> after_zero_or_not;
  for (int i = 0; i < KnotSlots::levels; ++i) {
    after_zero_or_not[i > 0].code(SmallNumber::most, [&](Probability one, bool bit) {
      encoder.encode(bit, one);
      return bit;
    });
  }
  encoder.encode_plain(0, 2);
  KnotModel loaded;
  ASSERT_TRUE(loaded.load_prior(encoder.finish()));
  KnotScales greatest;
  greatest.columns = 1;
  greatest.codes.assign(KnotSlots::count, KnotScales::most);
  greatest.keep({true, false});
  EXPECT_EQ(loaded.prior(false), KnotModel(greatest).prior(false));
}

}  // namespace
}  // namespace reprise
