#include "refine/refinement.h"

#include <gtest/gtest.h>

#include <random>

#include "query/promise.h"
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

/// A take as a layer gives it back.
struct Decoded {
  Refinement refinement;
  ChannelMatrix channels;  ///< of the source's frames
};

Decoded refined(const Take& take, const RefinementOptions& options) {
  const PreparedTake prepared = prepare_take(take);
  Decoded decoded{refine(prepared, options), {}};
  const TakeShape shape{prepared.take.frames(), take.frame_rate};
  ChannelMatrix channels =
      decode_refinement(*take.skeleton, prepared.header.constants, shape, decoded.refinement.bytes);
  EXPECT_TRUE(channels == decoded.refinement.decoded) << "decoding gives something else";
  decoded.channels = restore_take(*take.skeleton, prepared.header, std::move(channels));
  return decoded;
}

/// No joint is further off, none is turned further, and none pops.
void expect_bounds(const Take& take, const ChannelMatrix& channels, double mm, double degrees) {
  MotionDistances distances = motion_distances(*take.skeleton, take.channels, channels);
  const MotionErrors errors = summarise_motion(distances, take.skeleton->joints.size());
  EXPECT_LE(errors.places.max, mm);
  EXPECT_LE(errors.turns.max, degrees);
  Take decoded = take;
  decoded.channels = channels;
  EXPECT_LE(greatest_pop(take, decoded), degrees);
  const ChannelConstants constants = find_constants(*take.skeleton, take.channels);
  for (std::size_t c = 0; c < constants.size(); ++c) {
    if (!constants[c]) continue;
    const auto column = channels.col(static_cast<Eigen::Index>(c)).array();
    EXPECT_EQ(column.maxCoeff(), column.minCoeff()) << "channel " << c;
    EXPECT_NEAR(column(0), *constants[c], 1e-6) << "channel " << c;
  }
}

/// Refines, decodes, writes the take as text and reads it: within the bound everywhere.
std::size_t expect_bound(const Take& take, double bound) {
  const Decoded decoded = refined(take, {bound, bound});
  expect_bounds(take, decoded.channels, bound, bound);
  Take written = take;
  written.channels = decoded.channels;
  const std::string text = write_motion(written);
  const Take read = take.skeleton->format == MotionFormat::bvh
                        ? read_bvh(text, "take.bvh")
                        : read_amc(text, "take.amc", take.skeleton);
  expect_bounds(take, read.channels, bound, bound);
  return decoded.refinement.bytes.size();
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
  const PreparedTake prepared = prepare_take(take);
  const TakeShape shape{prepared.take.frames(), take.frame_rate};
  const Refinement refinement = refine(prepared, {10, 10});
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    auto bytes = refinement.bytes;
    if (i % 2 == 0) bytes.resize(random() % bytes.size());
    for (int k = 0; k < 1 + i % 5 && !bytes.empty(); ++k) {
      bytes[i % 4 == 1 ? random() % std::min<std::size_t>(bytes.size(), 64)
                       : random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    try {
      const ChannelMatrix channels =
          decode_refinement(*take.skeleton, prepared.header.constants, shape, bytes);
      EXPECT_EQ(channels.rows(), prepared.take.frames());
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
    const Decoded with = refined(take, {10, 10, true});
    const Decoded without = refined(take, {10, 10, false});
    EXPECT_EQ(without.refinement.contact_bytes, 0);
    EXPECT_LE(part_of_sources(with.channels), 1.1);
    expect_bounds(take, with.channels, 10, 10);
    EXPECT_LT(static_cast<double>(with.refinement.bytes.size()),
              1.1 * static_cast<double>(without.refinement.bytes.size()));
    if (with.refinement.contact_bytes == 0) continue;
    ++held;
    EXPECT_GT(part_of_sources(without.channels), part_of_sources(with.channels));
  }
  EXPECT_GT(held, 0);
}

TEST(ChannelCoding, BytesThatEndEndTheKnots) {
  const Take take = synthetic_take(MotionFormat::bvh, 1);
  const ChannelConstants all_move(static_cast<std::size_t>(take.skeleton->channel_count));
  CodedChannels channels(*take.skeleton, all_move, {20000, 120}, {0, 8});
  RangeDecoder decoder({});
  EXPECT_FALSE(channels.steps.decode(decoder));
  RangeDecoder again({});
  channels.steps = StepGrid(*take.skeleton, channels.order, 20000, 8);
  const ChannelKnots knots = ChannelCoder().decode(again, channels.shape, channels.steps);
  EXPECT_TRUE((knots.rightCols(knots.cols() - 1).array() == 0).all()) << "read from nowhere";
}

INSTANTIATE_TEST_SUITE_P(Formats, Refinements,
                         testing::Values(MotionFormat::bvh, MotionFormat::asf_amc));

}  // namespace
}  // namespace reprise
