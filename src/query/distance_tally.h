// The errors of a whole library in a fixed amount of memory, however long it is.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reprise/model/measure.h"

namespace reprise {

class DistanceTally {
 public:
  DistanceTally();

  /// Distances in mm, not negative.
  void add(std::span<const float> distances);
  /// All that were added; 0 without any. p99 is within 0.1 % of what sorting them would give.
  PositionErrors errors() const;

 private:
  std::vector<std::uint64_t> counts_;  ///< by the leading bits of a distance
  std::uint64_t total_ = 0;
  double sum_ = 0;
  double squares_ = 0;
  float greatest_ = 0;
};

}  // namespace reprise
