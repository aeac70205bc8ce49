// When a foot is on the floor (docs/measures.md).
#pragma once

namespace reprise {

/// What is measured as foot skate and what is coded as a contact go by the same.
struct FootContact {
  static constexpr double height_mm = 50;         ///< above the floor; a foot on it is lower
  static constexpr double speed_mm_s = 150;       ///< over the ground; a foot that stands is slower
  static constexpr double half_window_s = 0.025;  ///< of the difference that a speed is
  /// Of the heights of all foot joints in all frames: the floor's.
  static constexpr double floor_percentile = 5;
};

}  // namespace reprise
