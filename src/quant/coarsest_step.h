// The search for the coarsest step that keeps an error.
#pragma once

#include <algorithm>
#include <cmath>

namespace reprise {

struct StepRange {
  int most = 0;        ///< indices are 0 .. most, from the finest on
  int per_octave = 1;  ///< indices by which a step doubles
  int first = 0;       ///< to begin with
};

/// The last index that is found to keep `error_at(index) <= allowed`, where a step finer than
/// another keeps it, too; -1 if there is none. Errors grow with about the power 0.8 of the step,
/// which saves looking at most indices. Each index is asked for once at most.
template <class ErrorAt>
int coarsest_step(const StepRange& range, double allowed, const ErrorAt& error_at) {
  constexpr double error_exponent = 0.8;
  int good = -1, bad = range.most + 1, step = range.first;
  while (good + 1 < bad) {
    step = std::clamp(step, good + 1, bad - 1);
    const double error = error_at(step);
    const bool keeps = error <= allowed;
    (keeps ? good : bad) = step;
    const double octaves = std::log2(allowed / std::max(error, 1e-6)) / error_exponent;
    const int move = static_cast<int>(std::lround(range.per_octave * octaves));
    step += keeps ? std::max(move, 1) : std::min(move, -1);
  }
  return good;
}

}  // namespace reprise
