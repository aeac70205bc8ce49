// The numbers that a printer of numbers can write, counted from zero upwards: a residual counts
// them, so what no printer writes costs nothing.
#pragma once

#include <array>
#include <cstdint>

namespace reprise {

enum class GridKind : std::uint8_t {
  linear = 0,       ///< every multiple of the unit
  significant = 1,  ///< at most so many significant digits
  single = 2,       ///< single-precision reals, rounded to the unit
};

/// Magnitudes are integers in units of 10^-decimals, below `most_magnitude`; each has an index.
class NumberGrid {
 public:
  static constexpr std::int64_t most_magnitude = std::int64_t{1} << 40;
  static constexpr int most_decimals = 9;

  NumberGrid() = default;
  /// `digits` (1 to 9) are the significant digits of that kind.
  NumberGrid(GridKind kind, int decimals, int digits);

  /// The index of the number next to a magnitude.
  std::int64_t index_of(std::int64_t magnitude) const;
  /// The magnitude of an index; 0 for one that is not of a magnitude below the limit.
  std::int64_t magnitude_of(std::int64_t index) const;
  /// How far a number's neighbours are, as 4 log2 of units.
  int log_step(std::int64_t magnitude) const;

 private:
  /// From `magnitude` on, numbers are `step` / 2^`shift` apart.
  struct Range {
    std::int64_t magnitude = 0;
    std::int64_t index = 0;
    std::int64_t step = 1;
    int shift = 0;
    int log_step = 0;
  };
  static constexpr int most_ranges = 20;

  const Range& range_of_magnitude(std::int64_t magnitude) const;
  const Range& range_of_index(std::int64_t index) const;

  std::array<Range, most_ranges> ranges_{};
  int range_count_ = 1;
  /// The range in which the numbers of each width in bits begin.
  std::array<std::uint8_t, 64> first_by_magnitude_{}, first_by_index_{};
  std::int64_t most_index_ = most_magnitude;
};

}  // namespace reprise
