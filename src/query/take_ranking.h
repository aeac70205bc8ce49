// Takes in the order of what can be said of them in a few numbers, before they are compared in
// full.
#pragma once

#include <vector>

#include "query/likeness.h"

namespace reprise {

/// Of each track: mean and deviation of its postures, how often each bone end goes back and forth,
/// and its duration, weighted as in LikenessConstants. A distance of two is about an unlikeness
/// (mm).
class TakeRanking {
 public:
  /// The tracks have one plan; they are not needed any more afterwards.
  explicit TakeRanking(const std::vector<const PostureTrack*>& tracks);

  /// The `count` tracks nearest to a whole track, nearest first, of those that `accept` says yes
  /// of.
  std::vector<std::size_t> nearest(const PostureTrack& query, std::size_t count,
                                   const std::vector<bool>& accept) const;

 private:
  static constexpr int numbers = 2 * posture_size + plan_bones + 1;
  using Description = Eigen::Matrix<float, 1, numbers>;
  static Description describe(const PostureTrack& track);

  Eigen::Matrix<float, Eigen::Dynamic, numbers, Eigen::RowMajor> descriptions_;
};

}  // namespace reprise
