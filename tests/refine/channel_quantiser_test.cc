#include "refine/channel_quantiser.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "quant/catmull_rom.h"
#include "reprise/model/measure.h"
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
  static constexpr double step_mm = 8, arm_mm = 60;

  PreparedTake prepared = prepare_take(synthetic_take(GetParam()));
  Take& take = prepared.take;
  CodedChannels fresh{*take.skeleton,
                      prepared.header.constants,
                      {take.frames(), take.frame_rate},
                      time_scales({take.frames(), take.frame_rate}, 0.5)};
};

TEST_P(ChannelQuantisers, ASecondTryGivesWhatAFirstOneWouldGive) {
  ChannelQuantiser quantiser(prepared, arm_mm);
  CodedChannels coded = fresh;
  quantiser.set_steps(step_mm, coded.steps);
  std::mt19937 random(5);
  for (int i = 0; i < 12; ++i) {
    const ChannelMatrix decoded = quantiser.quantise(coded);
    ChannelQuantiser other(prepared, arm_mm);
    CodedChannels expected = fresh;
    expected.steps = coded.steps;
    EXPECT_TRUE(decoded == other.quantise(expected)) << "try " << i;
    EXPECT_TRUE(coded.knots == expected.knots);
    EXPECT_TRUE(positions_of(quantiser.decoded()) == positions_of(other.decoded()));
    if (i == 6) {
      coded.steps.base[random() % coded.steps.base.size()] = -1;  // stored as it is
    } else {
      ++coded.steps.offsets(static_cast<Eigen::Index>(random() % coded.steps.offsets.size()));
    }
  }
}

TEST_P(ChannelQuantisers, DecodedChannelsAreThoseOfTheKnots) {
  ChannelQuantiser quantiser(prepared, arm_mm);
  CodedChannels coded = fresh;
  quantiser.set_steps(step_mm, coded.steps);
  const ChannelMatrix decoded = quantiser.quantise(coded);
  EXPECT_TRUE(decoded == coded.trajectories(*take.skeleton));
}

TEST_P(ChannelQuantisers, JointsAreNearerThanIfChannelsKnewNothingOfEachOther) {
  ChannelQuantiser quantiser(prepared, arm_mm);
  CodedChannels coded = fresh;
  quantiser.set_steps(step_mm, coded.steps);
  const auto mean_of = [&](const ChannelMatrix& decoded) {
    return position_errors(joint_positions(*take.skeleton, take.channels),
                           joint_positions(*take.skeleton, decoded))
        .mean;
  };
  const std::vector<int>& order = fresh.order.channels;
  ChannelMatrix apart = take.channels;
  for (std::size_t i = 0; i < order.size(); ++i) {
    Eigen::MatrixXd column = take.channels.col(order[i]);
    NestedKnots::from_frames(column, coded.shape.levels);
    for (Eigen::Index f = 0; f < column.rows(); ++f) {
      const double step = coded.steps.step(i, f);
      column(f) = std::round(column(f) / step) * step;
    }
    NestedKnots::to_frames(column, coded.shape.levels);
    apart.col(order[i]) = column;
  }
  EXPECT_LT(mean_of(quantiser.quantise(coded)), 0.7 * mean_of(apart));
}

INSTANTIATE_TEST_SUITE_P(Formats, ChannelQuantisers,
                         testing::Values(MotionFormat::bvh, MotionFormat::asf_amc));

}  // namespace
}  // namespace reprise
