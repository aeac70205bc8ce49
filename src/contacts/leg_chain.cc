#include "contacts/leg_chain.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <numbers>

namespace reprise {

using Eigen::Vector3d;

namespace {

constexpr double degrees_per_radian = 180.0 / std::numbers::pi;
constexpr int most_angles = LegChainConstants::most_angles;

using AngleVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_angles, 1>;
using AngleMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_angles, most_angles>;
using JacobianMatrix = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, most_angles>;

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
  for (const int joint : point_joints_) point_index_.push_back(chain_index(joint));
  for (const int j : leg.joints) {
    const Joint& joint = skeleton.joints[static_cast<std::size_t>(j)];
    for (std::size_t k = 0; k < joint.rotation_order.size(); ++k) {
      const int channel = joint.first_channel + joint.rotation_slots[k];
      if (!moves[static_cast<std::size_t>(channel)]) continue;
      if (angles_.size() < static_cast<std::size_t>(most_angles)) {
        angles_.push_back({chain_index(j), static_cast<int>(k), channel});
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
  frames_.resize(chain_.joints.size());
  axes_.resize(angles_.size());
  centres_.resize(angles_.size());
}

std::size_t LegChain::chain_index(int joint) const {
  const auto at = std::lower_bound(chain_joint_.begin(), chain_joint_.end(), joint);
  assert(at != chain_joint_.end() && *at == joint);
  return static_cast<std::size_t>(at - chain_joint_.begin());
}

void LegChain::place(std::span<const double> channels, std::span<Vector3d> places) {
  forward_kinematics(chain_, channels, frames_);
  for (std::size_t p = 0; p < point_index_.size(); ++p) {
    places[p] = frames_[point_index_[p]].position;
  }
}

void LegChain::find_axes(std::span<const double> channels) {
  const bool about_itself = chain_.format == MotionFormat::bvh;
  for (std::size_t a = 0; a < angles_.size(); ++a) {
    const Angle& angle = angles_[a];
    const Joint& joint = chain_.joints[angle.joint];
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    Vector3d parent_place = Vector3d::Zero();
    if (joint.parent >= 0) {
      const JointFrame& parent = frames_[static_cast<std::size_t>(joint.parent)];
      axes = parent.rotation;
      parent_place = parent.position;
    }
    axes *= joint.axis;
    for (int k = 0; k < angle.rotation; ++k) {
      const auto slot = static_cast<std::size_t>(joint.rotation_slots[static_cast<std::size_t>(k)]);
      const double degrees = channels[static_cast<std::size_t>(joint.first_channel) + slot];
      axes *= axis_rotation(joint.rotation_order[static_cast<std::size_t>(k)],
                            degrees / degrees_per_radian);
    }
    axes_[a] = axes.col(joint.rotation_order[static_cast<std::size_t>(angle.rotation)]);
    // A bone of an ASF skeleton turns about its parent's point.
    centres_[a] = about_itself ? frames_[angle.joint].position : parent_place;
  }
}

void LegChain::reach(std::span<double> channels, std::span<const JointGoal> goals) {
  const auto count = static_cast<Eigen::Index>(angles_.size());
  constexpr double stiffness = LegChainConstants::stiffness_mm * LegChainConstants::stiffness_mm;
  AngleVector turned = AngleVector::Zero(count);
  std::array<double, most_angles> start{};
  for (std::size_t a = 0; a < angles_.size(); ++a) {
    start[a] = channels[static_cast<std::size_t>(angles_[a].channel)];
  }
  forward_kinematics(chain_, channels, frames_);
  for (int round = 0; round < LegChainConstants::rounds; ++round) {
    if (round > 0) forward_kinematics_from(chain_, first_turning_, channels, frames_);
    find_axes(channels);
    // Least |J d - missing|^2 + stiffness |turned + d|^2: the pull back is to where the angles
    // began, so that nothing depends on the way there.
    AngleMatrix normal = stiffness * AngleMatrix::Identity(count, count);
    AngleVector right = -stiffness * turned;
    double missing = 0;
    for (const JointGoal& goal : goals) {
      const std::size_t joint = chain_index(goal.joint);
      const Vector3d way = goal.place - frames_[joint].position;
      JacobianMatrix jacobian = JacobianMatrix::Zero(3, count);
      for (Eigen::Index a = 0; a < count; ++a) {
        const auto at = static_cast<std::size_t>(a);
        if (turns_[at][joint]) {
          jacobian.col(a) = axes_[at].cross(frames_[joint].position - centres_[at]);
        }
      }
      const JacobianMatrix weighted = goal.weight * jacobian;
      normal.noalias() += weighted.transpose() * jacobian;
      right.noalias() += weighted.transpose() * way;
      missing += goal.weight * way.squaredNorm();
    }
    normal.diagonal().array() += LegChainConstants::caution * missing;
    turned += normal.llt().solve(right);
    for (std::size_t a = 0; a < angles_.size(); ++a) {
      channels[static_cast<std::size_t>(angles_[a].channel)] =
          start[a] + degrees_per_radian * turned[static_cast<Eigen::Index>(a)];
    }
  }
}

}  // namespace reprise
