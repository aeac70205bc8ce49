#include "contacts/contact_stage.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

#include "contacts/contact_correction.h"
#include "contacts/leg_chain.h"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// What is added to the places of a joint in the contacts of its point.
using PathCorrector =
    std::function<ContactCorrection(const JointPath&, std::span<const ContactInterval>)>;

/// Holds the points of one leg during contacts.
class LegHolder {
 public:
  LegHolder(LegChain& chain, const Leg& leg, ChannelMatrix& channels)
      : chain_(chain), leg_(leg), channels_(channels), places_(chain.point_joints().size()) {
    for (JointPath& path : places_) path.setZero(3, channels.rows());
  }

  /// Of all frames; `hold` needs those in which something may change.
  void place() { place(0, channels_.rows()); }
  void place(Index first, Index end) {
    std::vector<Vector3d> at(places_.size());
    for (Index f = first; f < end; ++f) {
      chain_.place(row(f), at);
      for (std::size_t j = 0; j < at.size(); ++j) places_[j].col(f) = at[j];
    }
  }

  /// `contacts[p]` are those of the leg's point p.
  void hold(const std::vector<std::vector<ContactInterval>>& contacts, const PathCorrector& correct,
            int rounds) {
    std::vector<ContactCorrection> own;
    for (std::size_t p = 0; p < leg_.points.size(); ++p) {
      for (std::size_t j = 0; j < leg_.points[p].size(); ++j) {
        own.push_back(correct(places_[own.size()], contacts[p]));
      }
    }
    std::vector<JointGoal> goals(own.size());
    for (Index f = 0; f < channels_.rows(); ++f) {
      if (set_goals(own, f, goals)) chain_.reach(row(f), goals, rounds);
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

/// Contacts of the points of a leg, the first of which is point `first` of all.
std::vector<std::vector<ContactInterval>> contacts_of(const Leg& leg, int first,
                                                      const TakeContacts& contacts) {
  std::vector<std::vector<ContactInterval>> own(leg.points.size());
  for (const ContactInterval& contact : contacts.intervals) {
    const int point = contact.point - first;
    if (point >= 0 && point < static_cast<int>(own.size())) {
      own[static_cast<std::size_t>(point)].push_back(contact);
    }
  }
  return own;
}

/// `hold(holder, contacts)` for each leg that can turn and has contacts.
template <class Hold>
void hold_legs(const Skeleton& skeleton, std::span<const Leg> legs, const TakeContacts& contacts,
               const std::vector<bool>& moves, ChannelMatrix& channels, const Hold& hold) {
  int first = 0;
  for (const Leg& leg : legs) {
    const auto own = contacts_of(leg, first, contacts);
    first += static_cast<int>(leg.points.size());
    if (std::ranges::all_of(own, [](const auto& of_point) { return of_point.empty(); })) continue;
    LegChain chain(skeleton, leg, moves);
    if (!chain.can_turn()) continue;
    LegHolder holder(chain, leg, channels);
    hold(holder, own);
  }
}

}  // namespace

std::vector<bool> moving_channels(const ChannelMatrix& channels) {
  std::vector<bool> moves;
  for (Index c = 0; c < channels.cols(); ++c) {
    // Where there are no frames, there is no memory to point into either.
    moves.push_back(channels.rows() > 0 && (channels.col(c).array() != channels(0, c)).any());
  }
  return moves;
}

void apply_contacts(const Skeleton& skeleton, std::span<const Leg> legs, double frame_rate,
                    const TakeContacts& contacts, const std::vector<bool>& moves,
                    ChannelMatrix& channels) {
  if (contacts.intervals.empty() || channels.rows() == 0) return;
  const double half_mean_s =
      ContactStageConstants::half_means_s[static_cast<std::size_t>(contacts.hold)];
  hold_legs(skeleton, legs, contacts, moves, channels, [&](LegHolder& holder, const auto& own) {
    holder.place();
    holder.hold(
        own,
        [&](const JointPath& places, const auto& intervals) {
          return correct_path(places, frame_rate, intervals, half_mean_s);
        },
        LegChainConstants::rounds);
  });
}

void steady_contacts(const Skeleton& skeleton, std::span<const Leg> legs, double frame_rate,
                     const TakeContacts& contacts, const std::vector<bool>& moves,
                     ChannelMatrix& channels) {
  if (contacts.intervals.empty() || channels.rows() == 0) return;
  const double half_window_s =
      ContactStageConstants::half_windows_s[static_cast<std::size_t>(contacts.hold)];
  hold_legs(skeleton, legs, contacts, moves, channels, [&](LegHolder& holder, const auto& own) {
    for (const auto& of_point : own) {
      for (const ContactInterval& contact : of_point) holder.place(contact.first, contact.end);
    }
    holder.hold(
        own,
        [&](const JointPath& places, const auto& intervals) {
          return steady_path(places, frame_rate, intervals, half_window_s);
        },
        LegChainConstants::rounds_nearby);
  });
}

}  // namespace reprise
