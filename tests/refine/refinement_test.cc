#include "refine/refinement.h"

#include <gtest/gtest.h>

#include <cmath>
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

TEST_P(Refinements, ATPoseInFrontDisturbsNothing) {
  const Take without = synthetic_take(GetParam());
  Take with = without;
  with.channels.resize(without.frames() + 1, without.channels.cols());
  with.channels.bottomRows(without.frames()) = without.channels;
  with.channels.row(0) = without.channels.row(0);
  for (const Joint& joint : with.skeleton->joints) {
    for (const int slot : joint.rotation_slots) {
      with.channels(0, joint.first_channel + slot) = slot == joint.rotation_slots.front() ? 80 : 0;
    }
  }
  const Decoded decoded = refined(with, {10, 10});
  expect_bounds(with, decoded.channels, 10, 10);
  EXPECT_TRUE(decoded.channels.bottomRows(without.frames()) == refined(without, {10, 10}).channels);
}

TEST_P(Refinements, AHeadingThatWrapsIsCodedAsOneThatDoesNot) {
  Take smooth = synthetic_take(GetParam());
  const Joint& root = smooth.skeleton->joints.front();
  const auto heading = root.first_channel + root.rotation_slots[1];
  for (Eigen::Index f = 0; f < smooth.frames(); ++f) {
    smooth.channels(f, heading) += 4.0 * static_cast<double>(f);
  }
  Take wrapped = smooth;
  for (double& angle : wrapped.channels.col(heading).reshaped()) {
    angle -= 360 * std::round(angle / 360);
  }
  const Decoded a = refined(smooth, {10, 10}), b = refined(wrapped, {10, 10});
  expect_bounds(wrapped, b.channels, 10, 10);
  EXPECT_NEAR(static_cast<double>(b.refinement.bytes.size()),
              static_cast<double>(a.refinement.bytes.size()),
              0.02 * static_cast<double>(a.refinement.bytes.size()));
  // In the source's own branch.
  EXPECT_LT((b.channels - wrapped.channels).col(heading).cwiseAbs().maxCoeff(), 90);
}

/// A joint with position channels that never change is a bone of one length.
TEST(RefinementOfBones, PositionChannelsThatDoNotMoveMakeUpForNothing) {
  std::string text = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n";
  const std::string six =
      "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n";
  text += six;
  for (const char* name : {"b", "c", "d"}) {
    text += std::string("JOINT ") + name + "\n{\nOFFSET 1 30 2\n" + six;
  }
  text += "End Site\n{\nOFFSET 0 10 0\n}\n}\n}\n}\n}\n";
  Take take;
  take.skeleton = std::make_shared<Skeleton>(read_bvh_skeleton(text, "bones.bvh", 10));
  take.frame_rate = 60;
  take.channels.resize(200, 24);
  for (Eigen::Index f = 0; f < 200; ++f) {
    for (Eigen::Index c = 0; c < 24; ++c) {
      const double time = static_cast<double>(f) / 60;
      const bool place = c % 6 < 3;
      take.channels(f, c) = place && c >= 6
                                ? 25.5 + static_cast<double>(c)
                                : 40 * std::sin((1 + 0.1 * static_cast<double>(c)) * time);
    }
  }
  const Decoded decoded = refined(take, {10, 10});
  expect_bounds(take, decoded.channels, 10, 10);
  for (Eigen::Index c = 6; c < 24; ++c) {
    if (c % 6 < 3) EXPECT_TRUE((decoded.channels.col(c).array() == take.channels(0, c)).all()) << c;
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
