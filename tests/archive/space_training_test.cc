#include "archive/space_training.h"

#include <gtest/gtest.h>

#include "ingest/skeletons.h"

namespace reprise {
namespace {

TEST(SpaceTraining, AxesAreCoarserWhereTheyOutweighTheCurves) {
  EXPECT_GT(axis_share(4000, 30000), axis_share(2000, 30000));
  EXPECT_GT(axis_share(4000, 30000), axis_share(4000, 300000));
  EXPECT_EQ(axis_share(4000, 0), TrainingConstants::most_axis_share);
  EXPECT_EQ(axis_share(4000, 1e12), TrainingConstants::least_axis_share);
}

/// An angle that is 170 or -170 degrees in turn is 0 on average, which no take is near.
TEST(SpaceTraining, TheStartIsWhereMostTakesBegin) {
  Take take;
  take.skeleton = testing_skeletons::chain();
  const auto channels = static_cast<std::size_t>(take.skeleton->channel_count);
  LayoutEvidence evidence;
  for (const double angle : {170.0, -170.0, 170.0}) {
    take.channels = ChannelMatrix::Constant(40, take.skeleton->channel_count, -angle);
    take.channels.topRows(6).setConstant(angle);
    evidence.add(layout_evidence(prepare_take(take)));
  }
  ASSERT_EQ(evidence.first_frames.size(), 3u);
  MarkerLayout layout = make_marker_layout(*take.skeleton, choose_layout(*take.skeleton, evidence));
  MarkerMoments moments;
  moments.add(mark_take(layout, take).markers);
  const CoefficientSpace space = train_space(std::move(layout), moments, evidence, 20);
  EXPECT_EQ(space.start, std::vector<double>(channels, 170.0));
}

}  // namespace
}  // namespace reprise
