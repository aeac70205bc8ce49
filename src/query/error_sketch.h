// The distribution of a take's distances in a few bytes, so that a whole archive's 99th percentile
// can be told.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace reprise {

/// Quantiles of distances (mm), one byte each. `distances` is sorted on the way.
std::vector<std::uint8_t> sketch_distances(std::vector<float>& distances);

/// Sketches of many takes put together.
class DistanceSketches {
 public:
  void add(std::span<const std::uint8_t> sketch, std::uint64_t distances);
  /// The distance (mm) that a part of all distances does not pass; 0 without any.
  double quantile(double part) const;

 private:
  struct Step {
    double distance;
    double weight;
  };
  std::vector<Step> steps_;
};

}  // namespace reprise
