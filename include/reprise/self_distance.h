// Why motions of a take count as repeated: its self-distance plot with paths, behaviours and clips.
#pragma once

#include <vector>

#include "reprise/archive.h"

namespace reprise {

/// Pixel (x, y) of the plot compares the postures at x / rate and y / rate seconds.
struct SelfDistance {
  struct Pixel {
    long x = 0;
    long y = 0;
  };
  /// A part of the take, in seconds.
  struct Behaviour {
    double start = 0;
    double end = 0;
    int group = 0;  ///< from 1 on; parts of one group are one behaviour
  };

  double rate = 0;                 ///< samples a second
  long samples = 0;                ///< the plot has samples x samples pixels
  std::vector<float> distance_mm;  ///< row after row: root mean square of joints, on leading axes
  std::vector<std::vector<Pixel>> paths;  ///< similar-posture paths of the half where y > x
  std::vector<Behaviour> behaviours;      ///< they follow one another
  std::vector<ClipInfo> clips;            ///< those of the archive; they follow one another
};

/// Compares a stored take with itself. Long takes are sampled less often, so that the plot has at
/// most 2,000 x 2,000 pixels. Throws Error (damaged).
SelfDistance self_distance(const Archive& archive, const TakeInfo& take);

}  // namespace reprise
