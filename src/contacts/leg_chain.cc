#include "contacts/leg_chain.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "model/angle_units.h"

namespace reprise {

using Eigen::Vector3d;

namespace {

constexpr std::size_t most_angles = LegChainConstants::most_angles;

/// Indices of the joints on the way from the root to a leg's points, in file order.
std::vector<int> joints_on_the_way(const Skeleton& skeleton, const std::vector<int>& points) {
  std::vector<int> result;
  for (const int point : points) {
    for (int j = point; j >= 0; j = skeleton.joints[static_cast<std::size_t>(j)].parent) {
      result.push_back(j);
    }
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace

LegChain::LegChain(const Skeleton& skeleton, const Leg& leg, const std::vector<bool>& moves) {
  for (const std::vector<int>& point : leg.points) {
    point_joints_.insert(point_joints_.end(), point.begin(), point.end());
  }
  chain_joint_ = joints_on_the_way(skeleton, point_joints_);
  chain_.format = skeleton.format;
  chain_.channel_count = skeleton.channel_count;
  chain_.millimetres_per_unit = skeleton.millimetres_per_unit;
  for (const int j : chain_joint_) {
    chain_.joints.push_back(skeleton.joints[static_cast<std::size_t>(j)]);
    int& parent = chain_.joints.back().parent;
    if (parent >= 0) parent = static_cast<int>(chain_index(parent));
  }
  for (const Joint& joint : chain_.joints) {
    first_axis_.push_back(axes_.size());
    axes_.resize(axes_.size() + joint.rotation_order.size());
  }
  frames_.resize(chain_.joints.size());
  for (const int joint : point_joints_) point_index_.push_back(chain_index(joint));
  for (const int j : leg.joints) {
    const Joint& joint = skeleton.joints[static_cast<std::size_t>(j)];
    for (std::size_t k = 0; k < joint.rotation_order.size(); ++k) {
      const int channel = joint.first_channel + joint.rotation_slots[k];
      if (!moves[static_cast<std::size_t>(channel)]) continue;
      if (angles_.size() < most_angles) {
        const std::size_t at = chain_index(j);
        // A bone of an ASF skeleton turns about its parent's point.
        const bool about_itself = chain_.format == MotionFormat::bvh || joint.parent < 0;
        const int centre = about_itself ? static_cast<int>(at) : chain_.joints[at].parent;
        angles_.push_back({at, first_axis_[at] + k, channel, centre});
      }
    }
  }
  if (!angles_.empty()) first_turning_ = angles_.front().joint;
  for (const Angle& angle : angles_) {
    std::vector<bool>& turned = turns_.emplace_back(chain_.joints.size(), false);
    for (std::size_t j = angle.joint; j < turned.size(); ++j) {
      const int parent = chain_.joints[j].parent;
      // A joint's own rotation moves its point in an ASF skeleton only.
      turned[j] = j == angle.joint || (parent >= 0 && turned[static_cast<std::size_t>(parent)]);
    }
  }
}

std::size_t LegChain::chain_index(int joint) const {
  const auto at = std::lower_bound(chain_joint_.begin(), chain_joint_.end(), joint);
  assert(at != chain_joint_.end() && *at == joint);
  return static_cast<std::size_t>(at - chain_joint_.begin());
}

void LegChain::place_joints(std::size_t first, std::span<const double> channels) {
  const JointFrame world;
  for (std::size_t j = first; j < frames_.size(); ++j) {
    const Joint& joint = chain_.joints[j];
    const JointFrame& parent =
        joint.parent < 0 ? world : frames_[static_cast<std::size_t>(joint.parent)];
    const auto axes = std::span(axes_).subspan(first_axis_[j], joint.rotation_order.size());
    frames_[j] = place_joint(chain_, joint, channels, parent, axes);
  }
}

void LegChain::place(std::span<const double> channels, std::span<Vector3d> places) {
  place_joints(0, channels);
  for (std::size_t p = 0; p < point_index_.size(); ++p) {
    places[p] = frames_[point_index_[p]].position;
  }
}

double LegChain::pull(const JointGoal& goal, NormalEquations& turns) const {
  const std::size_t joint = chain_index(goal.joint);
  const Vector3d way = goal.place - frames_[joint].position;
  std::array<std::size_t, most_angles> turning{};
  std::array<Vector3d, most_angles> moves;
  std::size_t count = 0;
  for (std::size_t a = 0; a < angles_.size(); ++a) {
    if (!turns_[a][joint]) continue;
    const Vector3d arm =
        frames_[joint].position - frames_[static_cast<std::size_t>(angles_[a].centre)].position;
    moves[count] = axes_[angles_[a].axis].cross(arm);
    turning[count++] = a;
  }
  turns.add<Vector3d>(std::span(turning).first(count), std::span(moves).first(count), goal.weight,
                      way);
  return goal.weight * way.squaredNorm();
}

void LegChain::reach(std::span<double> channels, std::span<const JointGoal> goals, int rounds) {
  constexpr double stiffness = LegChainConstants::stiffness_mm * LegChainConstants::stiffness_mm;
  std::array<double, most_angles> start{}, turned{};
  for (std::size_t a = 0; a < angles_.size(); ++a) {
    start[a] = channels[static_cast<std::size_t>(angles_[a].channel)];
  }
  place_joints(0, channels);
  for (int round = 0; round < rounds; ++round) {
    if (round > 0) place_joints(first_turning_, channels);
    // Least |J d - missing|^2 + stiffness |turned + d|^2: the pull back is to where the angles
    // began, so that nothing depends on the way there.
    NormalEquations turns(angles_.size());
    double missing = 0;
    for (const JointGoal& goal : goals) missing += pull(goal, turns);
    for (std::size_t a = 0; a < angles_.size(); ++a) {
      turns.add(a, stiffness, -turned[a]);
      turns.add(a, LegChainConstants::caution * missing, 0);
    }
    const std::array<double, most_angles> solution = turns.solve();
    if (!std::ranges::all_of(solution, [](double turn) { return std::isfinite(turn); })) return;
    for (std::size_t a = 0; a < angles_.size(); ++a) {
      turned[a] += solution[a];
      channels[static_cast<std::size_t>(angles_[a].channel)] =
          start[a] + degrees_per_radian * turned[a];
    }
  }
}

}  // namespace reprise
