#include "rma/plot_places.h"

#include <algorithm>
#include <cstdlib>

namespace reprise {
namespace {

/// A pixel this near (samples) to a path lies on it.
constexpr long near_path = 2;

}  // namespace

void TracedPlaces::add(const SimilarPath& path) {
  long x = std::max(0L, path.pixels.front().x - near_path);
  for (const PlotPixel& pixel : path.pixels) {
    for (x = std::max(x, pixel.x - near_path); x <= pixel.x; ++x) {
      places_[static_cast<std::size_t>(x)].push_back(pixel.y);
    }
  }
  pixels_ += path.pixels.size();
}

bool TracedPlaces::hold(const NearPair& pair) const {
  return std::ranges::any_of(places_[static_cast<std::size_t>(pair.sample)],
                             [&](long y) { return std::labs(y - pair.other_sample) <= near_path; });
}

PairPlaces::PairPlaces(std::span<const NearPair> near_pairs,
                       const std::vector<std::size_t>& pairs) {
  for (const std::size_t i : pairs) {
    places_.emplace_back(near_pairs[i].sample, near_pairs[i].other_sample);
  }
  std::ranges::sort(places_);
}

bool PairPlaces::has_next_to(const NearPair& pair, long most_samples) const {
  constexpr long steepest = RepeatConstants::steepest;
  for (long x = 1; x <= steepest * most_samples; ++x) {
    const long least = (x + steepest - 1) / steepest;
    const long most = x <= most_samples ? steepest * x : most_samples;
    const bool goes_on =
        any_in_column(pair.sample + x, pair.other_sample + least, pair.other_sample + most) ||
        any_in_column(pair.sample - x, pair.other_sample - most, pair.other_sample - least);
    if (goes_on) return true;
  }
  return false;
}

bool PairPlaces::any_in_column(long x, long first, long last) const {
  const auto at = std::ranges::lower_bound(places_, std::pair(x, first));
  return at != places_.end() && *at <= std::pair(x, last);
}

}  // namespace reprise
