// Smooth made-up postures: four joints that wander without ever doing the same twice.
#pragma once

#include <cmath>

#include "rma/postures.h"

namespace reprise {

/// The posture of performance `seed` at `time` (seconds): far from those of other seeds and times.
inline Eigen::RowVectorXf made_up_posture(int seed, double time) {
  Eigen::RowVectorXf posture(12);
  for (int c = 0; c < 12; ++c) {
    const double phase = 1.7 * c + 12.9898 * seed;
    posture[c] = static_cast<float>(300 * std::sin(phase + (0.9 + 0.23 * (c % 5)) * time) +
                                    150 * std::sin(2.1 * phase + 2.3 * time));
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

}  // namespace reprise
