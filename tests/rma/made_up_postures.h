// Smooth made-up postures: four joints that wander without ever doing the same twice.
#pragma once

#include <cmath>
#include <initializer_list>

#include "rma/posture_library.h"

namespace reprise {

/// A number in [0, 1) that looks drawn at random.
inline double scrambled(int seed, int number) {
  const double value = std::sin(78.233 * seed + 12.9898 * number) * 43758.5453;
  return value - std::floor(value);
}

/// The posture of performance `seed` at `time` (seconds): far from those of other seeds and times.
inline Eigen::RowVectorXf made_up_posture(int seed, double time) {
  constexpr double turn = 6.283185307179586;
  Eigen::RowVectorXf posture(12);
  for (int c = 0; c < 12; ++c) {
    const double slow = 0.7 + scrambled(seed, 4 * c), fast = 1.8 + scrambled(seed, 4 * c + 1);
    posture[c] =
        static_cast<float>(300 * std::sin(turn * scrambled(seed, 4 * c + 2) + slow * time) +
                           150 * std::sin(turn * scrambled(seed, 4 * c + 3) + fast * time));
  }
  return posture;
}

/// Samples of performance `seed` from `begin` (s) on, played at `speed`.
inline PostureMatrix made_up_take(int seed, double begin, double seconds, double speed = 1,
                                  double rate = 15) {
  PostureMatrix take(std::lround(seconds * rate), 12);
  for (long s = 0; s < take.rows(); ++s) {
    take.row(s) = made_up_posture(seed, begin + static_cast<double>(s) / rate * speed);
  }
  return take;
}

inline PostureMatrix joined(std::initializer_list<PostureMatrix> parts) {
  long rows = 0, at = 0;
  for (const PostureMatrix& part : parts) rows += part.rows();
  PostureMatrix all(rows, parts.begin()->cols());
  for (const PostureMatrix& part : parts) {
    all.middleRows(at, part.rows()) = part;
    at += part.rows();
  }
  return all;
}

/// A clip of 2 s at 3 s in take 0, at 2 s and half speed in take 1, at 4 s and 1.5 times in take 2.
inline PostureLibrary planted_library(const RepeatConstants& constants) {
  return PostureLibrary(
      {joined({made_up_take(2, 0, 3), made_up_take(1, 0, 2), made_up_take(3, 0, 3)}),
       joined({made_up_take(4, 0, 2), made_up_take(1, 0, 4, 0.5), made_up_take(5, 0, 2)}),
       joined({made_up_take(6, 0, 4), made_up_take(1, 0, 4.0 / 3, 1.5), made_up_take(7, 0, 2)}),
       made_up_take(8, 0, 8)},
      constants);
}

}  // namespace reprise
