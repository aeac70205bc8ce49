// What no two performances of a motion have in common.
#pragma once

#include "synth/poses.h"

namespace reprise::synth {

/// Low-passed Gaussian noise on frames [first, first + count), faded in and out over `fade` frames
/// at its ends; `degrees` is the RMS angle by which a joint is turned, `sigma` the low-pass in
/// seconds. With `free_only` a joint keeps the angles that its ASF bone does not have.
struct NoiseOptions {
  double degrees = 0;
  double sigma = 0.15;
  double frame_rate = 60;
  bool free_only = false;
  long first = 0;
  long count = 0;
  long fade = 0;
};

void add_noise(PoseMatrix& poses, const NoiseOptions& options, Random random);

}  // namespace reprise::synth
