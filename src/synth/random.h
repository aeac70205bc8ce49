// A random generator of our own: the same seed gives the same numbers with every compiler and
// library.
#pragma once

#include <cstdint>
#include <vector>

namespace reprise::synth {

/// SplitMix64 (Steele, Lea, Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  /// An independent generator for part `label` of what this one describes; does not advance this
  /// one.
  Random fork(std::uint64_t label) const;

  std::uint64_t next();
  /// In [0, 1).
  double uniform();
  double uniform(double low, double high);
  /// In [0, count); count is at least 1.
  std::size_t below(std::size_t count);
  bool chance(double probability);
  /// Mean 0, variance 1: the sum of four uniform numbers, which needs no library function.
  double gaussian();

  template <typename Value>
  void shuffle(std::vector<Value>& values) {
    for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[below(i)]);
  }

 private:
  std::uint64_t state_;
};

}  // namespace reprise::synth
