#include "refine/coding_order.h"

namespace reprise {
namespace {

std::vector<int> slots_outwards(const Joint& joint) {
  std::vector<int> slots;
  for (std::size_t c = 0; c < joint.channels.size(); ++c) {
    if (is_position(joint.channels[c])) slots.push_back(static_cast<int>(c));
  }
  slots.insert(slots.end(), joint.rotation_slots.begin(), joint.rotation_slots.end());
  for (std::size_t c = 0; c < joint.channels.size(); ++c) {
    if (joint.channels[c] == Channel::length) slots.push_back(static_cast<int>(c));
  }
  return slots;
}

}  // namespace

CodingOrder::CodingOrder(const Skeleton& skeleton, const std::vector<bool>& moves) {
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    int last = joint.parent < 0 ? -1 : last_turning[static_cast<std::size_t>(joint.parent)];
    int moving = last;
    slots.emplace_back();
    for (const int slot : slots_outwards(joint)) {
      const int channel = joint.first_channel + slot;
      CodedSlot coded{slot, -1};
      if (moves[static_cast<std::size_t>(channel)]) {
        coded.place = static_cast<int>(channels.size());
        channels.push_back(channel);
        parents.push_back(last);
        joints.push_back(static_cast<int>(j));
        last = coded.place;
      }
      // A BVH joint turns about itself.
      const bool turns = is_rotation(joint.channels[static_cast<std::size_t>(slot)]);
      if (skeleton.format != MotionFormat::bvh || !turns) moving = last;
      slots.back().push_back(coded);
    }
    last_moving.push_back(moving);
    last_turning.push_back(last);
  }
}

}  // namespace reprise
