// In which order channels are coded: from the root outwards, those that move.
#pragma once

#include <vector>

#include "reprise/model/skeleton.h"

namespace reprise {

/// A channel of a joint, in the order in which it acts: places, turns outermost first, stretch.
struct CodedSlot {
  int slot = 0;    ///< index in the joint's channels
  int place = -1;  ///< in the coding order; -1 where the channel does not move
};

/// A place is a position in the coding order: one a channel that moves, after all that it hangs on.
struct CodingOrder {
  /// `moves`: one a channel of a frame.
  CodingOrder(const Skeleton& skeleton, const std::vector<bool>& moves);

  std::size_t size() const { return channels.size(); }

  std::vector<int> channels;  ///< of each place: index in a frame
  std::vector<int> parents;   ///< of each place: the last place before it that it hangs on, or -1
  std::vector<int> joints;    ///< of each place
  std::vector<std::vector<CodedSlot>> slots;  ///< of each joint: all of its channels
  std::vector<int> last_moving;   ///< of each joint: the last place that moves its point, or -1
  std::vector<int> last_turning;  ///< of each joint: the last place at it or above it, or -1
};

}  // namespace reprise
