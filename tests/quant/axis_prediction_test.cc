#include "quant/axis_prediction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ingest/skeletons.h"
#include "ingest/trajectories.h"
#include "quant/axis_coder.h"

namespace reprise {
namespace {

MarkerLayout layout_of(const Skeleton& skeleton) {
  LayoutChoices choices;
  choices.active.assign(static_cast<std::size_t>(skeleton.channel_count), true);
  return make_marker_layout(skeleton, choices);
}

/// Markers of the posture without any rotation, in whole mm.
std::vector<std::int32_t> resting_markers(const MarkerLayout& layout,
                                          const std::shared_ptr<const Skeleton>& skeleton) {
  Take take;
  take.skeleton = skeleton;
  take.channels = ChannelMatrix::Zero(1, skeleton->channel_count);
  std::vector<std::int32_t> whole;
  const MarkerMatrix markers = mark_take(layout, take).markers;
  for (const double value : markers.row(0)) whole.push_back(static_cast<int>(std::lround(value)));
  return whole;
}

class AxisPrediction : public testing::Test {
 protected:
  const std::shared_ptr<const Skeleton> skeleton_ = testing_skeletons::branches();
  const MarkerLayout layout_ = layout_of(*skeleton_);
  const std::vector<std::int32_t> mean_ = resting_markers(layout_, skeleton_);

  /// Where a turn of the whole body takes a marker, in steps.
  MarkerEntries turned(std::size_t marker) const {
    const Eigen::Vector3d turn(3.0, -1.5, 2.0);
    const Eigen::Vector3d place(mean_[3 * marker], mean_[3 * marker + 1], mean_[3 * marker + 2]);
    const Eigen::Vector3d moved = turn.cross(place);
    return {std::lround(moved[0]), std::lround(moved[1]), std::lround(moved[2])};
  }
};

TEST_F(AxisPrediction, ABodyThatTurnsIsForetoldFromItsFirstMarkers) {
  AxisPredictor predictor(layout_, mean_);
  double anchored = 0, missed = 0;
  for (std::size_t m = 0; m < predictor.markers(); ++m) {
    const MarkerEntries entries = turned(m);
    const AxisPredictor::Foretold foretold = predictor.foretell(m);
    for (std::size_t a = 0; a < 3 && m >= predictor.markers() / 2; ++a) {
      const auto off = static_cast<double>(entries[a] - foretold.base[a]);
      anchored += off * off;
      const double rest = off - std::ldexp(static_cast<double>(foretold.turn[a]),
                                           -AxisPredictionConstants::turn_bits);
      missed += rest * rest;
    }
    predictor.learn(m, entries);
  }
  EXPECT_GT(anchored, 1000.0);
  EXPECT_LT(missed, 0.05 * anchored);
}

TEST_F(AxisPrediction, AnAxisKnowsNothingOfTheOneBefore) {
  AxisPredictor predictor(layout_, mean_), fresh(layout_, mean_);
  for (std::size_t m = 0; m < predictor.markers(); ++m) predictor.learn(m, turned(m));
  predictor.begin();
  for (std::size_t m = 0; m < predictor.markers(); ++m) {
    EXPECT_EQ(predictor.foretell(m).base, fresh.foretell(m).base);
    EXPECT_EQ(predictor.foretell(m).turn, fresh.foretell(m).turn);
    const MarkerEntries entries{static_cast<std::int64_t>(m), 1, -1};
    predictor.learn(m, entries);
    fresh.learn(m, entries);
  }
}

TEST_F(AxisPrediction, NothingTurnsWithoutAMean) {
  AxisPredictor predictor(layout_, {});
  for (std::size_t m = 0; m < predictor.markers(); ++m) {
    EXPECT_EQ(predictor.foretell(m).turn, MarkerEntries{});
    predictor.learn(m, turned(m));
  }
}

/// The sanitizer looks at the sums.
TEST_F(AxisPrediction, NoEntriesAreTooLarge) {
  std::vector<std::int32_t> far = mean_;
  for (std::size_t d = 0; d < far.size(); ++d)
    far[d] = d % 2 == 0 ? std::numeric_limits<std::int32_t>::max()
                        : std::numeric_limits<std::int32_t>::min();
  AxisPredictor predictor(layout_, far);
  for (std::size_t m = 0; m < predictor.markers(); ++m) {
    const std::int64_t most = m % 2 == 0 ? AxisCoder::most_entry : -AxisCoder::most_entry;
    for (const std::int64_t turn : predictor.foretell(m).turn)
      EXPECT_LE(std::abs(turn), std::int64_t{1} << 41);
    predictor.learn(m, {most, -most, most});
  }
}

}  // namespace
}  // namespace reprise
