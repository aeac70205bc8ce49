#include "quant/catmull_rom.h"

#include <gtest/gtest.h>

#include <random>

namespace reprise {
namespace {

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> values(-100, 100);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return values(random); });
}

TEST(NestedKnots, FramesComeBackForEveryLength) {
  for (Eigen::Index frames = 1; frames <= 140; ++frames) {
    for (int levels = 0; levels <= 7 && (Eigen::Index{1} << levels) <= 2 * frames; ++levels) {
      const Eigen::MatrixXd original = random_matrix(frames, 2, static_cast<unsigned>(frames));
      Eigen::MatrixXd knots = original;
      NestedKnots::from_frames(knots, levels);
      NestedKnots::to_frames(knots, levels);
      ASSERT_LT((knots - original).cwiseAbs().maxCoeff(), 1e-9) << frames << " frames, " << levels;
    }
  }
}

TEST(NestedKnots, StraightLinesNeedOnlyTheCoarsestKnots) {
  constexpr int levels = 4;
  Eigen::MatrixXd line(161, 1);
  for (Eigen::Index f = 0; f < line.rows(); ++f) line(f, 0) = 3.0 * static_cast<double>(f) - 7.0;
  NestedKnots::from_frames(line, levels);
  for (Eigen::Index f = 0; f < line.rows(); ++f) {
    if (knot_level(f, levels) < levels) {
      EXPECT_NEAR(line(f, 0), 0, 1e-9) << f;
    }
  }
}

TEST(NestedKnots, CubicCurvesNeedNoKnotsAwayFromTheEnds) {
  // Four points of a Catmull-Rom midpoint reproduce cubics.
  constexpr int levels = 2;
  Eigen::MatrixXd curve(129, 1);
  for (Eigen::Index f = 0; f < curve.rows(); ++f) {
    const double t = static_cast<double>(f) / 32.0 - 2.0;
    curve(f, 0) = t * t * t - 2 * t;
  }
  NestedKnots::from_frames(curve, levels);
  for (Eigen::Index f = 17; f < 112; ++f) {
    if (knot_level(f, levels) == 0) {
      EXPECT_NEAR(curve(f, 0), 0, 1e-9) << f;
    }
  }
}

TEST(NestedKnots, ErrorsOfKnotsAreErrorsOfFrames) {
  constexpr int levels = 6;
  const Eigen::MatrixXd noise = random_matrix(4096, 1, 5);
  Eigen::MatrixXd frames = noise;
  NestedKnots::to_frames(frames, levels);
  EXPECT_NEAR(frames.squaredNorm() / noise.squaredNorm(), 1.0, 0.25);
}

TEST(NestedKnots, LevelsFollowTheFrameRate) {
  EXPECT_EQ(knot_levels(120, 100000), 6);
  EXPECT_EQ(knot_levels(60, 100000), 5);
  EXPECT_EQ(knot_levels(30, 100000), 4);
  for (long frames = 1; frames < 200; ++frames) {
    EXPECT_TRUE(knot_levels(120, frames) == 0 || (1L << knot_levels(120, frames)) < frames);
  }
}

}  // namespace
}  // namespace reprise
