#include "quant/knot_order.h"

#include <gtest/gtest.h>

#include <cmath>

#include "quant/catmull_rom.h"

namespace reprise {
namespace {

KnotShape shape_of(long frames, double rate, CurveKind kind, CurveKind root_kind) {
  KnotShape shape;
  shape.frames = frames;
  shape.trajectories = 9;
  shape.root = 4;
  shape.direct = 2;
  shape.levels = knot_levels(rate, frames);
  shape.first_level = first_level_of(rate);
  shape.frame_rate = rate;
  shape.kind = kind;
  shape.root_kind = root_kind;
  return shape;
}

TEST(KnotOrder, EveryNumberOnceAndAfterItsNeighbours) {
  constexpr CurveKind kinds[] = {CurveKind::nested_knots, CurveKind::cosines};
  for (const long frames : {1L, 2L, 5L, 64L, 257L}) {
    for (const CurveKind kind : kinds) {
      for (const CurveKind root_kind : kinds) {
        const KnotShape shape = shape_of(frames, 30, kind, root_kind);
        Eigen::MatrixXi visits = Eigen::MatrixXi::Zero(frames, shape.trajectories);
        for (const KnotGroup& group : knot_order(shape)) {
          ASSERT_GE(group.slot, 0);
          ASSERT_LT(group.slot, KnotSlots::count);
          for (const KnotRow& row : group.rows) {
            for (const Eigen::Index near : {row.before, row.before_that, row.left, row.right}) {
              ASSERT_LT(near, frames);
              if (near >= 0) {
                EXPECT_EQ(visits(near, group.first_column), 1);
              }
            }
            for (int c = group.first_column; c < group.last_column; ++c) ++visits(row.row, c);
          }
        }
        EXPECT_EQ(visits, Eigen::MatrixXi::Ones(frames, shape.trajectories)) << frames;
      }
    }
  }
}

TEST(KnotOrder, LevelsThatAreAsLongShareASlotWhateverTheRate) {
  // Strides of 2^level frames, each as long in seconds as a finer take's.
  const auto slot_of = [](double rate, long stride) {
    const KnotShape shape = shape_of(600, rate, CurveKind::nested_knots, CurveKind::nested_knots);
    for (const KnotGroup& group : knot_order(shape)) {
      if (!group.coarsest && group.rows.front().row == stride) return group.slot;
    }
    return -1;
  };
  EXPECT_EQ(slot_of(120, 1), 0);
  EXPECT_EQ(slot_of(120, 2), slot_of(60, 1));
  EXPECT_EQ(slot_of(120, 8), slot_of(30, 2));
  EXPECT_EQ(slot_of(240, 1), 0);  // none is finer
}

TEST(KnotOrder, BandsAreOfTheSameFrequenciesWhateverTheTake) {
  const auto slot_at = [](long frames, double rate, double frequency) {
    const auto row = static_cast<Eigen::Index>(
        std::lround(frequency * 2.0 * static_cast<double>(frames) / rate));
    for (const KnotGroup& group :
         knot_order(shape_of(frames, rate, CurveKind::cosines, CurveKind::cosines))) {
      for (const KnotRow& one : group.rows) {
        if (one.row == row) return group.slot;
      }
    }
    return -1;
  };
  for (const double frequency : {0.1, 0.4, 1.6, 6.4}) {
    EXPECT_EQ(slot_at(3000, 30, frequency), slot_at(6000, 120, frequency)) << frequency;
  }
  EXPECT_LT(slot_at(3000, 30, 0.4), slot_at(3000, 30, 1.6));
}

}  // namespace
}  // namespace reprise
