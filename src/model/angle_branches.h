// The same rotation can be written in many ways: angles may differ by whole turns, and three angles
// about three axes have a second set on the other side of gimbal lock. Coders want numbers that are
// smooth; what comes out is written as the source wrote it.
#pragma once

#include <cstdint>
#include <vector>

#include "model/constant_channels.h"

namespace reprise {

/// From `frame` on, until the next branch of the joint, the source writes the joint's rotations in
/// another way than the smooth angles: `turns` whole turns more (one number a rotation, outermost
/// first), and `flipped` to the second set of angles (a + 180, 180 - b, c + 180).
struct AngleBranch {
  std::int32_t frame = 0;
  std::int32_t joint = 0;
  bool flipped = false;
  std::vector<std::int32_t> turns;

  bool operator==(const AngleBranch&) const = default;
};

/// Most whole turns that a branch is off; angles beyond are left as they are.
constexpr std::int32_t most_turns = 1 << 20;

/// True for rotations about three different axes, which have a second set of angles.
bool has_second_angles(const Joint& joint);

/// Makes angles smooth: no step from one frame to the next is larger than it has to be. Gives where
/// the source's own angles were other ones, by frame, then joint; a joint that would need a branch
/// in more than every fourth frame keeps its angles. Channels of `constants` stay as they are.
std::vector<AngleBranch> smooth_angles(const Skeleton& skeleton, const ChannelConstants& constants,
                                       ChannelMatrix& channels);

/// Smooth angles (or decoded ones near them) as the source wrote them. `branches` as above; their
/// joints and frames are there.
void restore_angles(const Skeleton& skeleton, const std::vector<AngleBranch>& branches,
                    ChannelMatrix& channels);

}  // namespace reprise
