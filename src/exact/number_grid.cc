#include "exact/number_grid.h"

#include <bit>
#include <cassert>

namespace reprise {
namespace {

/// Significand of a single-precision real.
constexpr int single_bits = 23;

std::int64_t power_of_ten(int exponent) {
  std::int64_t power = 1;
  for (int i = 0; i < exponent; ++i) power *= 10;
  return power;
}

/// 4 log2 of a ratio of at least 1, rounded down to a whole number.
int log_of(std::int64_t numerator, int shift) {
  int result = 0;
  std::int64_t power = numerator;
  while (power >= (std::int64_t{2} << shift)) power /= 2, result += 4;
  // 2^(1/4), 2^(2/4), 2^(3/4) in 1/1024.
  for (const int quarter : {1218, 1448, 1722}) {
    if (power * 1024 >= (std::int64_t{quarter} << shift)) ++result;
  }
  return result;
}

/// Ties go to the even number, as in printing.
std::int64_t rounded_shift(std::int64_t value, int shift) {
  if (shift == 0) return value;
  const std::int64_t whole = value >> shift;
  const std::int64_t rest = value - (whole << shift), half = std::int64_t{1} << (shift - 1);
  return whole + (rest > half || (rest == half && (whole & 1) != 0));
}

}  // namespace

NumberGrid::NumberGrid(GridKind kind, int decimals, int digits) {
  assert(decimals >= 0 && decimals <= most_decimals);
  const auto add = [&](std::int64_t magnitude, std::int64_t step, int shift) {
    const std::int64_t index = index_of(magnitude);
    ranges_[range_count_++] = {magnitude, index, step, shift, log_of(step, shift)};
  };
  if (kind == GridKind::significant) {
    assert(digits >= 1 && digits <= most_decimals);
    std::int64_t step = 10;
    for (auto m = power_of_ten(digits); m < most_magnitude; m *= 10, step *= 10) add(m, step, 0);
  } else if (kind == GridKind::single) {
    const std::int64_t one = power_of_ten(decimals);
    for (int p = 0; p <= single_bits; ++p) {
      const std::int64_t magnitude = one << p;
      if (magnitude >= most_magnitude) break;
      if (magnitude >= std::int64_t{1} << single_bits) add(magnitude, one, single_bits - p);
    }
  }
  for (int width = 1; width < 63; ++width) {
    const std::int64_t least = std::int64_t{1} << (width - 1);
    for (int r = 1; r < range_count_; ++r) {
      if (ranges_[r].magnitude <= least) first_by_magnitude_[width] = static_cast<std::uint8_t>(r);
      if (ranges_[r].index <= least) first_by_index_[width] = static_cast<std::uint8_t>(r);
    }
  }
  most_index_ = index_of(most_magnitude);
}

const NumberGrid::Range& NumberGrid::range_of_magnitude(std::int64_t magnitude) const {
  int r = first_by_magnitude_[std::bit_width(static_cast<std::uint64_t>(magnitude))];
  while (r + 1 < range_count_ && magnitude >= ranges_[r + 1].magnitude) ++r;
  return ranges_[r];
}

const NumberGrid::Range& NumberGrid::range_of_index(std::int64_t index) const {
  int r = first_by_index_[std::bit_width(static_cast<std::uint64_t>(index))];
  while (r + 1 < range_count_ && index >= ranges_[r + 1].index) ++r;
  return ranges_[r];
}

std::int64_t NumberGrid::index_of(std::int64_t magnitude) const {
  const Range& range = range_of_magnitude(magnitude);
  if (range.step == 1) return magnitude;
  const std::int64_t scaled = (magnitude - range.magnitude) << range.shift;
  const std::int64_t rounded = scaled + range.step / 2;
  // Most numbers are small, and so are their divisions.
  const std::int64_t steps = rounded >> 32 == 0 ? static_cast<std::uint32_t>(rounded) /
                                                      static_cast<std::uint32_t>(range.step)
                                                : rounded / range.step;
  return range.index + steps;
}

std::int64_t NumberGrid::magnitude_of(std::int64_t index) const {
  if (index < 0 || index >= most_index_) return 0;
  const Range& range = range_of_index(index);
  return range.magnitude + rounded_shift((index - range.index) * range.step, range.shift);
}

int NumberGrid::log_step(std::int64_t magnitude) const {
  return range_of_magnitude(magnitude).log_step;
}

}  // namespace reprise
