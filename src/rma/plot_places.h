// Places of the plot of two takes, to be looked up however many they are.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "rma/repeat_groups.h"
#include "rma/similar_posture_paths.h"

namespace reprise {

/// Where paths run that were traced in a plot.
class TracedPlaces {
 public:
  /// Paths of a plot are traced until they have this many pixels for each of its columns. Real
  /// takes have at most 26; noise about one posture, all of which is similar, has thousands, and
  /// more the longer it is (docs/findings/2026-11-27-long-takes.md).
  static constexpr std::size_t most_pixels_a_column = 200;

  /// None yet, in a plot of so many columns.
  explicit TracedPlaces(long columns) : places_(static_cast<std::size_t>(columns)) {}

  void add(const SimilarPath& path);
  bool full() const { return pixels_ >= most_pixels_a_column * places_.size(); }
  /// Whether a pair lies on a path, or next to it.
  bool hold(const NearPair& pair) const;

 private:
  std::vector<std::vector<long>> places_;  ///< of each column: other samples
  std::size_t pixels_ = 0;
};

/// The pairs of a plot.
class PairPlaces {
 public:
  /// `pairs` are indices.
  PairPlaces(std::span<const NearPair> near_pairs, const std::vector<std::size_t>& pairs);

  /// Whether a motion may go on from a pair to one of these, or from one of these to it: both
  /// forwards, the slower by at most so many samples and none more than RepeatConstants::steepest
  /// times as fast.
  bool has_next_to(const NearPair& pair, long most_samples) const;

 private:
  bool any_in_column(long x, long first, long last) const;

  std::vector<std::pair<long, long>> places_;  ///< samples and other samples, sorted
};

}  // namespace reprise
