// Layers of channels that keep a mean.
#include "refine/coarse_channels.h"

#include <gtest/gtest.h>

#include "reprise/model/measure.h"
#include "reprise/synth/library.h"

namespace reprise {
namespace {

constexpr std::size_t any_size = std::size_t{1} << 30;

Take synthetic_take(MotionFormat format, double seconds = 6) {
  SynthOptions options;
  options.takes = 1;
  options.seconds = seconds;
  options.format = format;
  return make_synthetic_library(options).takes.at(0);
}

PositionErrors errors_of(const Take& take, const ChannelMatrix& channels) {
  return position_errors(joint_positions(*take.skeleton, take.channels),
                         joint_positions(*take.skeleton, channels));
}

class CoarseChannels : public testing::TestWithParam<MotionFormat> {};

TEST_P(CoarseChannels, KeepTheirMeanAndComeNearIt) {
  const Take take = synthetic_take(GetParam());
  std::size_t before = 0;
  for (const double mean : {60.0, 20.0, 5.0, 0.5}) {
    const auto coarse = coarse_channels(prepare_take(take), {mean, true, any_size});
    ASSERT_TRUE(coarse) << mean;
    const PreparedTake prepared = prepare_take(take);
    ASSERT_TRUE(prepared.header.first_frame.empty());
    const ChannelMatrix decoded = decode_coarse_channels(
        *take.skeleton, prepared.header.constants, {take.frames(), take.frame_rate}, coarse->bytes);
    EXPECT_TRUE(decoded == coarse->decoded) << mean;
    const PositionErrors errors = errors_of(take, decoded);
    EXPECT_LE(errors.mean, mean);
    EXPECT_GT(errors.mean, 0.7 * mean);
    EXPECT_GT(coarse->bytes.size(), before) << mean;
    before = coarse->bytes.size();
  }
}

TEST_P(CoarseChannels, AreNoLargerThanWhatThereIs) {
  const Take take = synthetic_take(GetParam());
  const std::size_t bytes = coarse_channels(prepare_take(take), {20, true, any_size})->bytes.size();
  EXPECT_TRUE(coarse_channels(prepare_take(take), {20, true, 2 * bytes}));
  EXPECT_FALSE(coarse_channels(prepare_take(take), {20, true, bytes - 1}));
  EXPECT_FALSE(coarse_channels(prepare_take(take), {20, true, bytes / 2}));
  EXPECT_FALSE(coarse_channels(prepare_take(take), {20, true, 0}));
}

TEST_P(CoarseChannels, FeetStandAsStillAsTheSources) {
  const Take take = synthetic_take(GetParam(), 12);
  const PositionMatrix source = joint_positions(*take.skeleton, take.channels);
  const auto slides = [&](bool contacts) {
    const auto coarse = coarse_channels(prepare_take(take), {20, contacts, any_size});
    return foot_skate(*take.skeleton, source, joint_positions(*take.skeleton, coarse->decoded),
                      take.frame_rate);
  };
  const auto held = slides(true), free = slides(false);
  ASSERT_TRUE(held && free);
  EXPECT_LE(held->decoded, 1.1 * held->original);
  EXPECT_GT(free->decoded, 1.5 * free->original);
}

INSTANTIATE_TEST_SUITE_P(Formats, CoarseChannels,
                         testing::Values(MotionFormat::bvh, MotionFormat::asf_amc));

TEST(CoarseChannelsOf, AStillTakeAndOneFrameAndNone) {
  Take take = synthetic_take(MotionFormat::bvh);
  take.channels = ChannelMatrix(take.channels.row(0).replicate(30, 1));
  for (const long frames : {30L, 1L}) {
    take.channels = ChannelMatrix(take.channels.topRows(frames));
    const auto coarse = coarse_channels(prepare_take(take), {20, true, any_size});
    ASSERT_TRUE(coarse) << frames;
    EXPECT_LE(errors_of(take, coarse->decoded).mean, 20) << frames;
  }
  take.channels.resize(0, take.channels.cols());
  EXPECT_FALSE(coarse_channels(prepare_take(take), {20, true, any_size}));
}

}  // namespace
}  // namespace reprise
