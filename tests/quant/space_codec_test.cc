#include "quant/space_codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ingest/principal_components.h"
#include "quant/take_codec.h"
#include "reprise/error.h"
#include "reprise/synth/library.h"

namespace reprise {
namespace {

class SpaceCodec : public testing::Test {
 protected:
  SpaceCodec() {
    SynthOptions options;
    options.takes = 1;
    options.seconds = 4;
    take_ = make_synthetic_library(options).takes.at(0);
    LayoutChoices choices;
    choices.active.assign(static_cast<std::size_t>(take_.skeleton->channel_count), true);
    space_.layout = make_marker_layout(*take_.skeleton, choices);
    space_.start.assign(choices.active.size(), 0.0);
    MarkerMoments moments;
    moments.add(mark_take(space_.layout, take_).markers);
    space_.mean = moments.mean();
    const auto axes = principal_axes(moments.covariance(space_.mean),
                                     Eigen::MatrixXd(space_.layout.dimensions(), 0), 1.0);
    space_.axes = axes.axes;
    space_.variance = axes.variance;
  }

  Take take_;
  CoefficientSpace space_;
};

TEST_F(SpaceCodec, AxesComeBackAsFineAsAsked) {
  for (const double error : {0.1, 2.0}) {
    const SpacePrecision precision{0.5, error};
    const auto bytes = encode_space(space_, precision);
    const CoefficientSpace decoded = decode_space(bytes, *take_.skeleton, nullptr);
    ASSERT_EQ(decoded.axes.rows(), space_.axes.rows());
    ASSERT_EQ(decoded.axes.cols(), space_.axes.cols());
    EXPECT_EQ(decoded.layout.choices.active, space_.layout.choices.active);
    EXPECT_LT((decoded.mean - space_.mean).cwiseAbs().maxCoeff(), 0.5);
    for (Eigen::Index k = 0; k < space_.axes.cols(); ++k) {
      const double worst = (decoded.axes.col(k) - space_.axes.col(k)).cwiseAbs().maxCoeff();
      EXPECT_LT(worst * std::sqrt(space_.variance[k]), error) << "axis " << k;
    }
  }
}

TEST_F(SpaceCodec, ExtensionKeepsWhatItExtends) {
  CoefficientSpace base = space_;
  base.axes = space_.axes.leftCols(3).eval();
  base.variance = space_.variance.head(3).eval();
  const CoefficientSpace known = decode_space(encode_space(base, {}), *take_.skeleton, nullptr);
  CoefficientSpace more = known;
  more.axes.conservativeResize(Eigen::NoChange, 5);
  more.axes.rightCols(2) = space_.axes.middleCols(3, 2);
  more.variance.conservativeResize(5);
  more.variance.tail(2) = space_.variance.segment(3, 2);
  const CoefficientSpace decoded =
      decode_space(encode_extension(more, 3, {}), *take_.skeleton, &known);
  ASSERT_EQ(decoded.axes.cols(), 5);
  EXPECT_EQ(decoded.axes.leftCols(3), known.axes);
  EXPECT_EQ(decoded.mean, known.mean);
  EXPECT_EQ(decoded.start, known.start);
}

TEST_F(SpaceCodec, DamagedSpacesAndTakesAreErrorsOrMotion) {
  const auto good = pack_space({}, encode_space(space_, {}), KnotModel().prior(false));
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    auto bytes = good;
    if (i % 2 == 0) bytes.resize(random() % bytes.size());
    for (int k = 0; k < 1 + i % 5 && !bytes.empty(); ++k) {
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    try {
      unpack_space(bytes, *take_.skeleton, nullptr);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::damaged);
    }
  }
}

class TakeCodec : public SpaceCodec, public testing::WithParamInterface<CurveKinds> {};

INSTANTIATE_TEST_SUITE_P(Kinds, TakeCodec,
                         testing::Values(CurveKinds{CurveKind::nested_knots,
                                                    CurveKind::nested_knots},
                                         CurveKinds{CurveKind::cosines, CurveKind::cosines},
                                         CurveKinds{CurveKind::cosines, CurveKind::nested_knots}));

TEST_P(TakeCodec, TakesComeBackFromTheirBytes) {
  CodedSpace coded;
  coded.space = space_;
  const TakeShape shape{take_.frames(), take_.frame_rate};
  const MarkedTake marked = mark_take(space_.layout, take_);
  const CurveKinds kinds = GetParam();
  const TakeKnots knots =
      take_knots(space_, shape, marked.root.tumbles, to_trajectories(space_, take_, marked), kinds);
  const CodedMotion motion{false,
                           224,
                           kinds,
                           {{3, 1, {1, -2, 0}}, {9, -1, {0, 0, 4}}},
                           quantise(coded.model, knots, 224).knots,
                           {{{0, 12, 40}, {1, 16, 36}, {1, 44, 60}}, 2}};
  const auto bytes = encode_motion(coded.model, space_, shape, motion);
  const CodedMotion decoded = decode_motion(coded.model, space_, shape, bytes);
  EXPECT_EQ(decoded.knots, motion.knots);
  EXPECT_EQ(decoded.step_index, motion.step_index);
  EXPECT_EQ(decoded.kinds.coefficients, kinds.coefficients);
  EXPECT_EQ(decoded.kinds.root, kinds.root);
  // The trajectories themselves come back up to what the step leaves.
  const TrajectoryMatrix original = to_trajectories(space_, take_, marked);
  const TrajectoryMatrix back = dequantise(decoded.knots, knots.shape, decoded.step_index);
  const double each = (back - original).norm() / std::sqrt(static_cast<double>(original.size()));
  EXPECT_LT(each, quantiser_step(decoded.step_index));
  EXPECT_EQ(decoded.contacts, motion.contacts);
  ASSERT_EQ(decoded.switches.size(), 2u);
  EXPECT_EQ(decoded.switches[1].driven, -1);
  EXPECT_EQ(decoded.switches[0].quarter_turns, motion.switches[0].quarter_turns);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    try {
      const ChannelMatrix channels =
          decode_take(coded, *take_.skeleton, {}, shape, std::span(bytes).first(size));
      EXPECT_EQ(channels.rows(), take_.frames());
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::damaged);
    }
  }
}

}  // namespace
}  // namespace reprise
