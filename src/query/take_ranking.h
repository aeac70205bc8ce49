// Takes in the order of what can be said of them in a few numbers, before they are compared in
// full.
#pragma once

#include <vector>

#include "query/likeness.h"

namespace reprise {

/// The summary of each track: a distance of two is about an unlikeness (mm).
class TakeRanking {
 public:
  /// The tracks have one plan; they are not needed any more afterwards.
  explicit TakeRanking(const std::vector<const PostureTrack*>& tracks);

  /// The `count` tracks nearest to a whole track, nearest first, of those that `accept` says yes
  /// of.
  std::vector<std::size_t> nearest(const PostureTrack& query, std::size_t count,
                                   const std::vector<bool>& accept) const;

 private:
  using Description = Eigen::Matrix<float, 1, MotionSummary::numbers>;
  static Description describe(const PostureTrack& track);

  Eigen::Matrix<float, Eigen::Dynamic, MotionSummary::numbers, Eigen::RowMajor> descriptions_;
};

}  // namespace reprise
