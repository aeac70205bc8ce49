#include "quant/cosine_transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

TEST(CosineTransform, FramesComeBack) {
  for (const Index frames : {0, 1, 2, 3, 4, 17, 64, 97, 360, 1009}) {
    const MatrixXd original = 100.0 * MatrixXd::Random(frames, 3);
    MatrixXd cosines = original;
    frames_to_cosines(cosines);
    EXPECT_NEAR(cosines.norm(), original.norm(), 1e-9 * original.norm()) << frames;
    cosines_to_frames(cosines);
    EXPECT_LT((cosines - original).norm(), 1e-8) << frames;
  }
}

TEST(CosineTransform, OneNumberIsOneWave) {
  constexpr Index frames = 50;
  for (const Index k : {0, 1, 7, 49}) {
    MatrixXd cosines = MatrixXd::Zero(frames, 1);
    cosines(k, 0) = 3;
    cosines_to_frames(cosines);
    const double norm = std::sqrt((k == 0 ? 1.0 : 2.0) / frames);
    for (Index f = 0; f < frames; ++f) {
      const double angle = std::numbers::pi * (static_cast<double>(f) + 0.5) *
                           static_cast<double>(k) / static_cast<double>(frames);
      EXPECT_NEAR(cosines(f, 0), 3 * norm * std::cos(angle), 1e-12) << k << " " << f;
    }
  }
}

}  // namespace
}  // namespace reprise
