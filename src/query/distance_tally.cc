#include "query/distance_tally.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace reprise {
namespace {

/// The bits of a positive float order as it does. Those left keep 10 of its mantissa: bins are at
/// most 1/1024 of a distance wide.
constexpr int dropped_bits = 13;
constexpr std::size_t bins = std::size_t{1} << (31 - dropped_bits);

std::size_t bin_of(float distance) {
  return (std::bit_cast<std::uint32_t>(distance) & 0x7FFF'FFFFu) >> dropped_bits;
}

float least_of(std::size_t bin) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(bin) << dropped_bits);
}

}  // namespace

DistanceTally::DistanceTally() : counts_(bins) {}

void DistanceTally::add(std::span<const float> distances) {
  for (const float distance : distances) {
    ++counts_[bin_of(distance)];
    sum_ += distance;
    squares_ += static_cast<double>(distance) * distance;
    greatest_ = std::max(greatest_, distance);
  }
  total_ += distances.size();
}

PositionErrors DistanceTally::errors() const {
  PositionErrors errors;
  if (total_ == 0) return errors;
  const auto count = static_cast<double>(total_);
  errors.mean = sum_ / count;
  errors.rms = std::sqrt(squares_ / count);
  errors.max = greatest_;
  const double rank = 0.99 * (count - 1);
  double before = 0;
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const auto here = static_cast<double>(counts_[bin]);
    if (before + here > rank) {
      const double from = least_of(bin), to = std::min(least_of(bin + 1), greatest_);
      errors.p99 = from + (to - from) * (rank - before) / here;
      break;
    }
    before += here;
  }
  return errors;
}

}  // namespace reprise
