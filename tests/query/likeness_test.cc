#include "query/likeness.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "query/time_warp.h"
#include "reprise/synth/library.h"

namespace reprise {
namespace {

const SynthLibrary& library() {
  static const SynthLibrary made = [] {
    SynthOptions options;
    options.takes = 4;
    options.seconds = 6;
    return make_synthetic_library(options);
  }();
  return made;
}

Stretch whole(const PostureTrack& track) {
  return {0, static_cast<double>(track.frames() - 1) / PostureConstants::rate};
}

MotionForm form_of(const PostureTrack& track) { return motion_form(track, whole(track), 32); }

CostMatrix random_costs(long rows, long columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> values(0, 1);
  return CostMatrix::NullaryExpr(rows, columns, [&] { return values(random); });
}

/// The least sum over all paths, by trying each.
float least_sum(const CostMatrix& costs, long i, long j) {
  if (i == 0 && j == 0) return costs(0, 0);
  float best = std::numeric_limits<float>::infinity();
  if (i > 0) best = std::min(best, least_sum(costs, i - 1, j));
  if (j > 0) best = std::min(best, least_sum(costs, i, j - 1));
  if (i > 0 && j > 0) best = std::min(best, least_sum(costs, i - 1, j - 1));
  return best + costs(i, j);
}

TEST(TimeWarp, TheCheapestPathIsFound) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const CostMatrix costs = random_costs(2 + seed % 4, 3 + seed % 3, seed);
    const auto path = warping_path(costs);
    float sum = 0;
    for (const auto& [i, j] : path) sum += costs(i, j);
    EXPECT_NEAR(sum, least_sum(costs, costs.rows() - 1, costs.cols() - 1), 1e-5);
    EXPECT_NEAR(warped_cost(costs), sum / static_cast<float>(path.size()), 1e-6);
    EXPECT_EQ(path.front(), (std::pair<long, long>{0, 0}));
    EXPECT_EQ(path.back(), (std::pair<long, long>{costs.rows() - 1, costs.cols() - 1}));
  }
}

TEST(Likeness, AMotionIsLikeItselfAndOthersAreAsFarFromBothSides) {
  std::vector<PostureTrack> tracks;
  for (const Take& take : library().takes) tracks.push_back(posture_track(take));
  for (const PostureTrack& a : tracks) {
    EXPECT_LT(unlikeness(form_of(a), form_of(a), take_weights), 0.5);
    for (const PostureTrack& b : tracks) {
      EXPECT_NEAR(unlikeness(form_of(a), form_of(b), take_weights),
                  unlikeness(form_of(b), form_of(a), take_weights), 0.1);
      if (&a != &b) EXPECT_GT(unlikeness(form_of(a), form_of(b), take_weights), 5);
    }
  }
}

TEST(Likeness, RowsOfSummariesAreAsFarApartAsTheirMotions) {
  const MotionForm a = form_of(posture_track(library().takes[0]));
  const MotionForm b = form_of(posture_track(library().takes[1]));
  for (LikenessWeights weights : {take_weights, part_weights}) {
    weights.summary_part = 1;
    const float apart = (a.summary.row(weights) - b.summary.row(weights)).norm();
    EXPECT_NEAR(apart, unlikeness(a, b, weights), 1e-3);
    EXPECT_GT(apart, 5);
  }
}

TEST(Likeness, TakesThatTurnToOtherSidesAreLessAlikeThanTakesThatMoveUnsteadily) {
  MotionForm left = form_of(posture_track(library().takes[0]));
  constexpr long turning = posture_size - 1;
  MotionForm right = left, unsteady = left;
  left.summary.mean[turning] = 50;
  right.summary.mean[turning] = -50;
  unsteady.summary.mean[turning] = 50;
  unsteady.summary.deviation.tail<root_speeds>().array() += 100;
  EXPECT_GT(unlikeness(left, right, take_weights), 2 * unlikeness(left, unsteady, take_weights));
}

TEST(PostureTrack, HeadingAndPlaceOnTheGroundDoNotMatter) {
  const Take& take = library().takes[0];
  Take moved = take;
  const Joint& root = take.skeleton->joints[0];
  for (std::size_t c = 0; c < root.channels.size(); ++c) {
    const auto column = root.first_channel + static_cast<long>(c);
    if (root.channels[c] == Channel::x_position) moved.channels.col(column).array() += 70.0;
    if (root.channels[c] == Channel::z_position) moved.channels.col(column).array() -= 30.0;
  }
  const PostureTrack a = posture_track(take), b = posture_track(moved);
  ASSERT_EQ(a.frames(), b.frames());
  EXPECT_EQ(a.directions, b.directions);
  for (std::size_t i = 0; i < a.speeds.size(); ++i) EXPECT_NEAR(a.speeds[i], b.speeds[i], 1);
}

TEST(PostureTrack, BonesAreUnitVectorsAndLengthsDoNotMatter) {
  const Take& take = library().takes[0];
  auto larger = std::make_shared<Skeleton>(*take.skeleton);
  for (Joint& joint : larger->joints) joint.offset *= 1.3;
  Take grown = take;
  grown.skeleton = larger;
  const PostureTrack a = posture_track(take), b = posture_track(grown);
  for (std::size_t i = 0; i < a.directions.size(); ++i) {
    EXPECT_NEAR(a.directions[i], b.directions[i], 1);
  }
}

TEST(PostureTrack, ASingleFrameIsAMotion) {
  Take take = library().takes[0];
  const ChannelMatrix first = take.channels.topRows(1);
  take.channels = first;
  const PostureTrack track = posture_track(take);
  EXPECT_EQ(track.frames(), 1);
  EXPECT_LT(unlikeness(form_of(track), form_of(track), take_weights), 0.5);
  EXPECT_LT(mean_joint_distance(track, whole(track), track, whole(track)), 0.5);
}

TEST(BestFit, APartIsFoundWhereItIs) {
  const PostureTrack track = posture_track(library().takes[1]);
  const int frames = static_cast<int>(track.frames());
  const BodyPostures target = postures(track, whole(track), frames, 0.85f);
  const BodyPostures part = target.middleRows(frames / 3, 15);
  const ColumnRange found = best_fit(row_distances(part, target));
  EXPECT_NEAR(static_cast<double>(found.begin), frames / 3, 1);
  EXPECT_NEAR(static_cast<double>(found.end), frames / 3 + 15, 1);
}

TEST(BestFit, AQueryThatCannotFitTakesAllOfTheTarget) {
  const PostureTrack track = posture_track(library().takes[1]);
  const BodyPostures rows = postures(track, whole(track), 40, 0.85f);
  const ColumnRange found = best_fit(row_distances(rows, rows.topRows(5)));
  EXPECT_EQ(found.begin, 0);
  EXPECT_EQ(found.end, 5);
}

}  // namespace
}  // namespace reprise
