#include "refine/channel_quantiser.h"

#include <gtest/gtest.h>

#include <random>

#include "reprise/synth/library.h"

namespace reprise {
namespace {

Take synthetic_take(MotionFormat format) {
  SynthOptions options;
  options.takes = 1;
  options.seconds = 2;
  options.format = format;
  return make_synthetic_library(options).takes.at(0);
}

class ChannelQuantisers : public testing::TestWithParam<MotionFormat> {
 protected:
  static constexpr double step_mm = 8;

  Take take = synthetic_take(GetParam());
  CodedChannels fresh{*take.skeleton,
                      {take.frames(), take.frame_rate},
                      time_scales({take.frames(), take.frame_rate}, 0.5)};
};

TEST_P(ChannelQuantisers, ASecondTryGivesWhatAFirstOneWouldGive) {
  ChannelQuantiser quantiser(take, step_mm);
  CodedChannels coded = fresh;
  quantiser.set_steps(step_mm, coded.steps);
  std::mt19937 random(5);
  for (int i = 0; i < 12; ++i) {
    const ChannelMatrix decoded = quantiser.quantise(coded);
    ChannelQuantiser other(take, step_mm);
    CodedChannels expected = fresh;
    expected.steps = coded.steps;
    EXPECT_TRUE(decoded == other.quantise(expected)) << "try " << i;
    EXPECT_TRUE(coded.knots == expected.knots);
    EXPECT_TRUE(quantiser.positions() == other.positions());
    if (i == 6) {
      coded.steps.base[random() % coded.steps.base.size()] = -1;  // stored as it is
    } else {
      ++coded.steps.offsets(static_cast<Eigen::Index>(random() % coded.steps.offsets.size()));
    }
  }
}

TEST_P(ChannelQuantisers, DecodedChannelsAreThoseOfTheKnots) {
  ChannelQuantiser quantiser(take, step_mm);
  CodedChannels coded = fresh;
  quantiser.set_steps(step_mm, coded.steps);
  const ChannelMatrix decoded = quantiser.quantise(coded);
  EXPECT_TRUE(decoded == coded.channels(*take.skeleton));
}

INSTANTIATE_TEST_SUITE_P(Formats, ChannelQuantisers,
                         testing::Values(MotionFormat::bvh, MotionFormat::asf_amc));

}  // namespace
}  // namespace reprise
