#include "contacts/legs.h"

#include <algorithm>
#include <limits>

#include "model/up_direction.h"
#include "reprise/model/kinematics.h"
#include "reprise/model/measure.h"

namespace reprise {
namespace {

std::vector<bool> named_feet(const Skeleton& skeleton) {
  std::vector<bool> feet;
  for (const Joint& joint : skeleton.joints) feet.push_back(is_foot_joint(joint));
  return feet;
}

std::vector<bool> lowest_ends(const Skeleton& skeleton) {
  const std::size_t count = skeleton.joints.size();
  std::vector<bool> feet(count, false), has_child(count, false);
  for (const Joint& joint : skeleton.joints) {
    if (joint.parent >= 0) has_child[static_cast<std::size_t>(joint.parent)] = true;
  }
  const PositionMatrix rest =
      joint_positions(skeleton, ChannelMatrix::Zero(1, skeleton.channel_count));
  const UpDirection up(skeleton.up);
  const auto height = [&](std::size_t j) {
    return up.height(rest, 0, static_cast<Eigen::Index>(j));
  };
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t j = 0; j < count; ++j) {
    low = std::min(low, height(j));
    high = std::max(high, height(j));
  }
  for (std::size_t j = 0; j < count; ++j) {
    feet[j] = !has_child[j] && skeleton.joints[j].parent >= 0 &&
              height(j) <= low + LegConstants::lowest_part * (high - low);
  }
  return feet;
}

/// Collects the legs of a skeleton whose foot joints are known.
class LegFinder {
 public:
  LegFinder(const Skeleton& skeleton, const std::vector<bool>& feet) : joints_(skeleton.joints) {
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const int parent = joints_[j].parent;
      const int above = parent < 0 ? -1 : top_[static_cast<std::size_t>(parent)];
      top_.push_back(above >= 0 ? above : feet[j] ? static_cast<int>(j) : -1);
      if (feet[j]) feet_.push_back(static_cast<int>(j));
    }
    carried_.assign(joints_.size(), 0);
    for (const int top : tops()) {
      for (int j = top; j >= 0; j = parent_of(j)) ++carried_[static_cast<std::size_t>(j)];
    }
    turns_about_itself_ = skeleton.format == MotionFormat::bvh;
  }

  std::vector<Leg> legs() const {
    std::vector<Leg> result;
    for (const int top : tops()) {
      Leg leg;
      leg.points.push_back({top});
      std::vector<int> beyond;
      for (const int foot : feet_) {
        if (foot != top && top_[static_cast<std::size_t>(foot)] == top) beyond.push_back(foot);
      }
      if (!beyond.empty()) leg.points.push_back(std::move(beyond));
      leg.joints = turning_joints(leg, top);
      result.push_back(std::move(leg));
    }
    return result;
  }

 private:
  int parent_of(int joint) const { return joints_[static_cast<std::size_t>(joint)].parent; }

  std::vector<int> tops() const {
    std::vector<int> result;
    for (const int foot : feet_) {
      if (top_[static_cast<std::size_t>(foot)] == foot) result.push_back(foot);
    }
    return result;
  }

  std::vector<int> turning_joints(const Leg& leg, int top) const {
    std::vector<int> turning;
    const auto add = [&](int joint) {
      const bool turns = !joints_[static_cast<std::size_t>(joint)].rotation_order.empty();
      if (turns && std::ranges::find(turning, joint) == turning.end()) turning.push_back(joint);
    };
    for (const std::vector<int>& point : leg.points) {
      for (const int foot : point) {
        // A BVH joint turns what is below it, a bone of an ASF skeleton its own far end as well.
        for (int j = turns_about_itself_ ? parent_of(foot) : foot; j >= top; j = parent_of(j)) {
          add(j);
        }
      }
    }
    const std::size_t within = turning.size();
    for (int j = parent_of(top);
         j >= 0 && carried_[static_cast<std::size_t>(j)] == 1 && parent_of(j) >= 0 &&
         turning.size() < within + LegConstants::most_joints_above_foot;
         j = parent_of(j)) {
      add(j);
    }
    std::sort(turning.begin(), turning.end());
    return turning;
  }

  const std::vector<Joint>& joints_;
  bool turns_about_itself_ = true;
  std::vector<int> feet_;     // in file order
  std::vector<int> top_;      // of each joint: the first foot joint at or above it; -1: none
  std::vector<int> carried_;  // of each joint: how many legs are at or below it
};

}  // namespace

std::vector<Leg> find_legs(const Skeleton& skeleton) {
  std::vector<bool> feet = named_feet(skeleton);
  if (std::ranges::find(feet, true) == feet.end()) feet = lowest_ends(skeleton);
  return LegFinder(skeleton, feet).legs();
}

int count_points(const std::vector<Leg>& legs) {
  int points = 0;
  for (const Leg& leg : legs) points += static_cast<int>(leg.points.size());
  return points;
}

}  // namespace reprise
