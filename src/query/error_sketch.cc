#include "query/error_sketch.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reprise {
namespace {

constexpr std::array<double, 8> levels = {0.5, 0.8, 0.9, 0.95, 0.98, 0.99, 0.995, 0.999};
/// A byte is a distance in steps of 1/12 octave from 2^-8 mm on.
constexpr double steps_per_octave = 12;
constexpr double octave_bias = 8;

std::uint8_t byte_of(double distance) {
  if (distance <= 0) return 0;
  return static_cast<std::uint8_t>(std::clamp<long>(
      std::lround(steps_per_octave * (std::log2(distance) + octave_bias)), 0, 255));
}

double distance_of(std::uint8_t byte) {
  return std::pow(2.0, byte / steps_per_octave - octave_bias);
}

}  // namespace

std::vector<std::uint8_t> sketch_distances(std::vector<float>& distances) {
  if (distances.empty()) return {};
  std::sort(distances.begin(), distances.end());
  std::vector<std::uint8_t> sketch;
  for (const double level : levels) {
    const auto at = static_cast<std::size_t>(level * static_cast<double>(distances.size() - 1));
    sketch.push_back(byte_of(distances[at]));
  }
  return sketch;
}

void DistanceSketches::add(std::span<const std::uint8_t> sketch, std::uint64_t distances) {
  if (sketch.size() != levels.size()) return;
  // Between two levels the distances are spread evenly over a few steps.
  constexpr int pieces = 8;
  double from = 0, from_level = 0;
  for (std::size_t q = 0; q < levels.size(); ++q) {
    const double to = distance_of(sketch[q]);
    const double weight = (levels[q] - from_level) * static_cast<double>(distances);
    for (int p = 0; p < pieces; ++p) {
      steps_.push_back({from + (to - from) * (p + 0.5) / pieces, weight / pieces});
    }
    from = to;
    from_level = levels[q];
  }
  steps_.push_back({from, (1 - from_level) * static_cast<double>(distances)});
}

double DistanceSketches::quantile(double part) const {
  std::vector<Step> sorted = steps_;
  std::sort(sorted.begin(), sorted.end(),
            [](const Step& a, const Step& b) { return a.distance < b.distance; });
  double total = 0;
  for (const Step& step : sorted) total += step.weight;
  double below = 0;
  for (const Step& step : sorted) {
    below += step.weight;
    if (below >= part * total) return step.distance;
  }
  return 0;
}

}  // namespace reprise
