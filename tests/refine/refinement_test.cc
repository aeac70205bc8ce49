#include "refine/refinement.h"

#include <gtest/gtest.h>

#include <random>

#include "refine/coded_channels.h"
#include "reprise/error.h"
#include "reprise/formats/motion_file.h"
#include "reprise/model/measure.h"
#include "reprise/synth/library.h"

namespace reprise {
namespace {

Take synthetic_take(MotionFormat format, double seconds = 3) {
  SynthOptions options;
  options.takes = 1;
  options.seconds = seconds;
  options.format = format;
  return make_synthetic_library(options).takes.at(0);
}

TakeShape shape_of(const Take& take) { return {take.frames(), take.frame_rate}; }

double worst_distance(const Take& take, const ChannelMatrix& channels) {
  return position_errors(joint_positions(*take.skeleton, take.channels),
                         joint_positions(*take.skeleton, channels))
      .max;
}

/// Refines, decodes, writes the take as text and reads it: within the bound everywhere.
std::size_t expect_bound(const Take& take, double bound_mm) {
  const Refinement refinement = refine(take, {bound_mm});
  const ChannelMatrix decoded = decode_refinement(*take.skeleton, shape_of(take), refinement.bytes);
  EXPECT_TRUE(decoded == refinement.decoded) << "decoding gives something else";
  EXPECT_LE(refinement.max_mm, bound_mm);
  EXPECT_NEAR(worst_distance(take, decoded), refinement.max_mm, 1e-6 * bound_mm);
  Take written = take;
  written.channels = decoded;
  const std::string text = write_motion(written);
  const Take read = take.skeleton->format == MotionFormat::bvh
                        ? read_bvh(text, "take.bvh")
                        : read_amc(text, "take.amc", take.skeleton);
  EXPECT_LE(worst_distance(take, read.channels), bound_mm);
  return refinement.bytes.size();
}

class Refinements : public testing::TestWithParam<MotionFormat> {};

TEST_P(Refinements, KeepEveryBound) {
  const Take take = synthetic_take(GetParam());
  std::size_t before = 0;
  for (const double bound : {100.0, 10.0, 1.0, 0.05}) {
    const std::size_t bytes = expect_bound(take, bound);
    EXPECT_GT(bytes, before) << bound;
    before = bytes;
  }
}

TEST_P(Refinements, KeepTheBoundWhereMotionJumps) {
  Take take = synthetic_take(GetParam());
  const long middle = take.frames() / 2;
  take.channels.row(middle).array() += 500;
  take.channels(middle / 2, 0) = 1e9;
  take.channels(middle / 2, 4) = -7e8;
  expect_bound(take, 10);
  expect_bound(take, 0.05);
}

TEST_P(Refinements, KeepTheBoundOnNoise) {
  Take take = synthetic_take(GetParam(), 1);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-720, 720);
  for (double& value : take.channels.reshaped()) value = any(random);
  expect_bound(take, 3);
}

TEST_P(Refinements, TakesOfFewFrames) {
  const Take whole = synthetic_take(GetParam());
  for (const long frames : {1L, 2L, 3L, 5L}) {
    Take take = whole;
    take.channels = whole.channels.topRows(frames).eval();
    expect_bound(take, 1);
  }
}

TEST_P(Refinements, StandingStillCostsNothing) {
  Take take = synthetic_take(GetParam());
  take.channels.rowwise() = take.channels.row(0).eval();
  Take once = take;
  once.channels = take.channels.topRows(1).eval();
  EXPECT_LT(expect_bound(take, 1), expect_bound(once, 1) + 100);
}

TEST_P(Refinements, HostileBytesAreDamageOrMotion) {
  const Take take = synthetic_take(GetParam(), 1);
  const Refinement refinement = refine(take, {10});
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    auto bytes = refinement.bytes;
    if (i % 2 == 0) bytes.resize(random() % bytes.size());
    for (int k = 0; k < 1 + i % 5 && !bytes.empty(); ++k) {
      bytes[i % 4 == 1 ? random() % std::min<std::size_t>(bytes.size(), 64)
                       : random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    try {
      const ChannelMatrix channels = decode_refinement(*take.skeleton, shape_of(take), bytes);
      EXPECT_EQ(channels.rows(), take.frames());
      EXPECT_TRUE(channels.allFinite());
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::damaged);
    }
  }
}

TEST(RefinementContacts, FeetSlideAsTheSourcesWithinTheBound) {
  SynthOptions options;
  options.takes = 2;
  options.seconds = 3;
  int held = 0;
  for (const Take& take : make_synthetic_library(options).takes) {
    const PositionMatrix source = joint_positions(*take.skeleton, take.channels);
    const auto part_of_sources = [&](const ChannelMatrix& channels) {
      const auto skate = foot_skate(*take.skeleton, source,
                                    joint_positions(*take.skeleton, channels), take.frame_rate);
      return skate->decoded / skate->original;
    };
    const Refinement with = refine(take, {10, true});
    const Refinement without = refine(take, {10, false});
    EXPECT_EQ(without.contact_bytes, 0);
    EXPECT_LE(part_of_sources(with.decoded), 1.1);
    EXPECT_LE(with.max_mm, 10);
    EXPECT_LT(static_cast<double>(with.bytes.size()),
              1.1 * static_cast<double>(without.bytes.size()));
    if (with.contact_bytes == 0) continue;
    ++held;
    EXPECT_GT(part_of_sources(without.decoded), part_of_sources(with.decoded));
    EXPECT_TRUE(decode_refinement(*take.skeleton, shape_of(take), with.bytes) == with.decoded);
  }
  EXPECT_GT(held, 0);
}

TEST(ChannelCoding, BytesThatEndEndTheKnots) {
  const Take take = synthetic_take(MotionFormat::bvh, 1);
  CodedChannels channels(*take.skeleton, {20000, 120}, {0, 8});
  RangeDecoder decoder({});
  EXPECT_FALSE(channels.steps.decode(decoder));
  RangeDecoder again({});
  channels.steps = StepGrid(*take.skeleton, 20000, 8);
  const ChannelKnots knots = ChannelCoder().decode(again, channels.shape, channels.steps);
  EXPECT_TRUE((knots.rightCols(knots.cols() - 1).array() == 0).all()) << "read from nowhere";
}

INSTANTIATE_TEST_SUITE_P(Formats, Refinements,
                         testing::Values(MotionFormat::bvh, MotionFormat::asf_amc));

}  // namespace
}  // namespace reprise
