// Sizes of the knots that are coded already, from which contexts expect the next one's. These
// belong to the archive format.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cstdint>

#include "quant/magnitude_bins.h"

namespace reprise {

/// Magnitudes as contexts see them: in steps of offset 0, with this many bits after the point.
constexpr int size_bits = 20;
constexpr std::int32_t most_size = 1 << 16;

/// A size in steps that are finer by half octaves, coarser where that is negative.
inline std::uint64_t in_finer_steps(std::uint64_t size, int half_octaves) {
  if (half_octaves & 1) size = (size * root_of_two) >> 16;
  const int octaves = half_octaves >> 1;
  return octaves >= 0 ? size << octaves : size >> -octaves;
}

/// Logarithmic bins of sums, one or two an octave.
inline std::uint32_t size_bin(std::uint64_t sum, std::uint32_t count, int per_octave) {
  if (sum == 0) return 0;
  const auto width = static_cast<int>(std::bit_width(sum));
  auto result = static_cast<std::uint32_t>(width * per_octave);
  if (per_octave == 2 && width > 1) result += static_cast<std::uint32_t>(sum >> (width - 2) & 1);
  return std::min(result, count - 1);
}

/// Sizes of knots, frames x channels, with zeros where the neighbours of a knot may lie outside: in
/// two coarsest strides before the first frame, one after the last, and two channels before the
/// first.
class KnotSizes {
 public:
  KnotSizes(Eigen::Index frames, Eigen::Index channels, int levels)
      : margin_(Eigen::Index{2} << levels),
        values_(Values::Zero(frames + margin_ + margin_ / 2, channels + 2)) {}

  /// Of a channel from -2 on: its first frame.
  const std::uint64_t* column(Eigen::Index channel) const { return &values_(margin_, channel + 2); }
  std::uint64_t* column(Eigen::Index channel) { return &values_(margin_, channel + 2); }

 private:
  using Values = Eigen::Matrix<std::uint64_t, Eigen::Dynamic, Eigen::Dynamic>;
  Eigen::Index margin_;
  Values values_;
};

}  // namespace reprise
