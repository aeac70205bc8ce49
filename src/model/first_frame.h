// The first frame of a recording is often no part of its motion: a T pose, or a pose at the origin.
#pragma once

#include "reprise/model/take.h"

namespace reprise {

struct FirstFrameConstants {
  /// It is apart if a joint turns or travels more into the second frame than this ...
  static constexpr double least_degrees = 15;
  static constexpr double least_mm = 100;
  /// ... and so many times more than in any step of this long after it.
  static constexpr double times_more = 4;
  static constexpr double compared_s = 0.5;
  static constexpr long least_frames = 4;
};

/// True if the first frame does not lead into the second one: some joint's turn against its parent,
/// or the way of the joint that carries the motion, is far larger than in the steps that follow.
bool first_frame_is_apart(const Take& take);

}  // namespace reprise
