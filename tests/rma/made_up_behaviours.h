// Made-up behaviours: four joints that swing about a posture of their own, each in its own way.
#pragma once

#include "rma/made_up_postures.h"

namespace reprise {

/// Behaviour `seed`, swinging about once a second.
inline PostureMatrix swinging(int seed, double seconds, double rate = 15) {
  constexpr double turn = 6.283185307179586;
  PostureMatrix take(std::lround(seconds * rate), 12);
  for (long s = 0; s < take.rows(); ++s) {
    const double time = static_cast<double>(s) / rate;
    for (int c = 0; c < 12; ++c) {
      const double place = 400 * scrambled(seed, 5 * c) - 200;
      const double swing = 100 * scrambled(seed, 5 * c + 1);
      const double wobble = 3 * std::sin(turn * (0.3 + scrambled(seed, 5 * c + 2)) * time);
      take(s, c) = static_cast<float>(
          place + swing * std::sin(turn * (time + scrambled(seed, 5 * c + 3) / 4)) + wobble);
    }
  }
  return take;
}

}  // namespace reprise
