#include "contacts/contact_stage.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "contacts/contact_correction.h"
#include "contacts/leg_chain.h"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

std::vector<bool> moving_channels(const ChannelMatrix& channels) {
  std::vector<bool> moves;
  for (Index c = 0; c < channels.cols(); ++c) {
    moves.push_back((channels.col(c).array() != channels(0, c)).any());
  }
  return moves;
}

/// Holds the points of one leg during contacts.
class LegHolder {
 public:
  LegHolder(LegChain& chain, const Leg& leg, ChannelMatrix& channels)
      : chain_(chain), leg_(leg), channels_(channels), places_(chain.point_joints().size()) {
    for (JointPath& path : places_) path.resize(3, channels.rows());
    std::vector<Vector3d> at(places_.size());
    for (Index f = 0; f < channels.rows(); ++f) {
      chain_.place(row(f), at);
      for (std::size_t j = 0; j < at.size(); ++j) places_[j].col(f) = at[j];
    }
  }

  /// `contacts[p]` are those of the leg's point p.
  void hold(const std::vector<std::vector<ContactInterval>>& contacts, double frame_rate,
            double half_mean_s) {
    std::vector<ContactCorrection> own;
    for (std::size_t p = 0; p < leg_.points.size(); ++p) {
      for (std::size_t j = 0; j < leg_.points[p].size(); ++j) {
        own.push_back(correct_path(places_[own.size()], frame_rate, contacts[p], half_mean_s));
      }
    }
    std::vector<JointGoal> goals(own.size());
    for (Index f = 0; f < channels_.rows(); ++f) {
      if (set_goals(own, f, goals)) chain_.reach(row(f), goals);
    }
  }

 private:
  std::span<double> row(Index f) {
    return {channels_.row(f).data(), static_cast<std::size_t>(channels_.cols())};
  }

  /// A point that does not stand goes along with the one that does, loosely. False where nothing is
  /// to do.
  bool set_goals(const std::vector<ContactCorrection>& own, Index f,
                 std::vector<JointGoal>& goals) const {
    const auto frame = static_cast<std::size_t>(f);
    std::vector<Vector3d> mean(leg_.points.size(), Vector3d::Zero());
    Vector3d all = Vector3d::Zero();
    bool any = false;
    std::size_t at = 0;
    for (std::size_t p = 0; p < leg_.points.size(); ++p) {
      for (std::size_t j = 0; j < leg_.points[p].size(); ++j, ++at) {
        mean[p] += own[at].offset.col(f) / static_cast<double>(leg_.points[p].size());
        any = any || own[at].force[frame] > 0;
      }
      all += mean[p];
    }
    if (!any) return false;
    at = 0;
    for (std::size_t p = 0; p < leg_.points.size(); ++p) {
      const double share = 1.0 / static_cast<double>(leg_.points[p].size());
      for (std::size_t j = 0; j < leg_.points[p].size(); ++j, ++at) {
        const double force = own[at].force[frame];
        const Vector3d offset = own[at].offset.col(f) + (1 - force) * (all - mean[p]);
        const double weight = std::max(force, ContactStageConstants::free_weight) * share;
        goals[at] = {chain_.point_joints()[at], places_[at].col(f) + offset, weight};
      }
    }
    return true;
  }

  LegChain& chain_;
  const Leg& leg_;
  ChannelMatrix& channels_;
  std::vector<JointPath> places_;  // of each joint of the leg's points, as decoded
};

}  // namespace

void apply_contacts(const Skeleton& skeleton, std::span<const Leg> legs, double frame_rate,
                    const TakeContacts& contacts, ChannelMatrix& channels) {
  if (contacts.intervals.empty() || channels.rows() == 0) return;
  const double half_mean_s =
      ContactStageConstants::half_means_s[static_cast<std::size_t>(contacts.hold)];
  const std::vector<bool> moves = moving_channels(channels);
  int point = 0;
  for (const Leg& leg : legs) {
    std::vector<std::vector<ContactInterval>> own(leg.points.size());
    bool any = false;
    for (std::vector<ContactInterval>& of_point : own) {
      for (const ContactInterval& contact : contacts.intervals) {
        if (contact.point == point) of_point.push_back(contact);
      }
      any = any || !of_point.empty();
      ++point;
    }
    LegChain chain(skeleton, leg, moves);
    if (any && chain.can_turn()) LegHolder(chain, leg, channels).hold(own, frame_rate, half_mean_s);
  }
}

}  // namespace reprise
