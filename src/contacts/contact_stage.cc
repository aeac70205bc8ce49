#include "contacts/contact_stage.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "contacts/leg_chain.h"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
/// 3 x frames.
using Path = Eigen::Matrix3Xd;

std::vector<bool> moving_channels(const ChannelMatrix& channels) {
  std::vector<bool> moves;
  for (Index c = 0; c < channels.cols(); ++c) {
    moves.push_back((channels.col(c).array() != channels(0, c)).any());
  }
  return moves;
}

/// From offset `from` with slope `from_slope` (a part of the way) to `to`, in a cubic.
Vector3d cubic_between(const Vector3d& from, const Vector3d& from_slope, const Vector3d& to,
                       const Vector3d& to_slope, double part) {
  const double rest = 1 - part;
  return (1 + 2 * part) * rest * rest * from + part * rest * rest * from_slope +
         part * part * (3 - 2 * part) * to - part * part * rest * to_slope;
}

/// How much of a contact is in force: 1 in it, less beside it; 0 where nothing changes.
double fading(double part) { return 1 - part * part * (3 - 2 * part); }

/// What has to be added to a joint's places so that it stands in its contacts.
struct Correction {
  Path offset;                // 3 x frames
  std::vector<double> force;  // of each frame, 0 .. 1
};

class CorrectionMaker {
 public:
  CorrectionMaker(const Path& places, double frame_rate)
      : places_(places), rate_(frame_rate), sums_(3, places.cols() + 1) {
    sums_.col(0).setZero();
    for (Index f = 0; f < places.cols(); ++f) sums_.col(f + 1) = sums_.col(f) + places.col(f);
    result_.offset = Path::Zero(3, places.cols());
    result_.force.assign(static_cast<std::size_t>(places.cols()), 0.0);
  }

  Correction run(std::span<const ContactInterval> contacts) {
    for (const ContactInterval& contact : contacts) hold(contact);
    for (std::size_t i = 0; i <= contacts.size() && !contacts.empty(); ++i) {
      const ContactInterval* before = i > 0 ? &contacts[i - 1] : nullptr;
      const ContactInterval* after = i < contacts.size() ? &contacts[i] : nullptr;
      fill_gap(before, after);
    }
    return std::move(result_);
  }

 private:
  /// A state of the correction between two contacts: a value, its slope a frame, and its force.
  struct Knot {
    Index frame = 0;
    Vector3d offset = Vector3d::Zero();
    Vector3d slope = Vector3d::Zero();
    double force = 0;
  };

  Index frames_of(double seconds) const {
    return std::max<Index>(1, std::lrint(std::min(seconds * rate_, 1e9)));
  }

  void hold(const ContactInterval& contact) {
    const Index half = frames_of(ContactStageConstants::half_mean_s);
    for (Index f = contact.first; f < contact.end; ++f) {
      const Index from = std::max<Index>(contact.first, f - half);
      const Index to = std::min<Index>(contact.end, f + half + 1);
      const Vector3d mean = (sums_.col(to) - sums_.col(from)) / static_cast<double>(to - from);
      result_.offset.col(f) = mean - places_.col(f);
      result_.force[static_cast<std::size_t>(f)] = 1;
    }
  }

  Knot last_of(const ContactInterval& contact) const {
    const Index f = contact.end - 1;
    const Index before = std::max<Index>(contact.first, f - 1);
    return {f, result_.offset.col(f), result_.offset.col(f) - result_.offset.col(before), 1};
  }
  Knot first_of(const ContactInterval& contact) const {
    const Index f = contact.first;
    const Index after = std::min<Index>(contact.end - 1, f + 1);
    return {f, result_.offset.col(f), result_.offset.col(after) - result_.offset.col(f), 1};
  }

  /// One curve between contacts that are near each other, else one from each of them to zero.
  void fill_gap(const ContactInterval* before, const ContactInterval* after) {
    const Index fade = frames_of(ContactStageConstants::fade_s);
    if (before && after && after->first - before->end < 2 * fade) {
      curve(last_of(*before), first_of(*after));
      return;
    }
    if (before) {
      const Knot last = last_of(*before);
      curve(last, Knot{last.frame + fade});
    }
    if (after) {
      const Knot first = first_of(*after);
      curve(Knot{first.frame - fade}, first);
    }
  }

  /// Between two knots, both left out; the curve may begin or end outside the take.
  void curve(const Knot& from, const Knot& to) {
    const auto length = static_cast<double>(to.frame - from.frame);
    const Index end = std::min<Index>(to.frame, places_.cols());
    for (Index f = std::max<Index>(from.frame + 1, 0); f < end; ++f) {
      const double part = static_cast<double>(f - from.frame) / length;
      result_.offset.col(f) =
          cubic_between(from.offset, length * from.slope, to.offset, length * to.slope, part);
      result_.force[static_cast<std::size_t>(f)] =
          from.force * fading(part) + to.force * fading(1 - part);
    }
  }

  const Path& places_;
  double rate_;
  Path sums_;
  Correction result_;
};

/// Holds the points of one leg during contacts.
class LegHolder {
 public:
  LegHolder(LegChain& chain, const Leg& leg, ChannelMatrix& channels)
      : chain_(chain), leg_(leg), channels_(channels), places_(chain.point_joints().size()) {
    for (Path& path : places_) path.resize(3, channels.rows());
    std::vector<Vector3d> at(places_.size());
    for (Index f = 0; f < channels.rows(); ++f) {
      chain_.place(row(f), at);
      for (std::size_t j = 0; j < at.size(); ++j) places_[j].col(f) = at[j];
    }
  }

  /// `contacts[p]` are those of the leg's point p.
  void hold(const std::vector<std::vector<ContactInterval>>& contacts, double frame_rate) {
    std::vector<Correction> own;
    for (std::size_t p = 0; p < leg_.points.size(); ++p) {
      for (std::size_t j = 0; j < leg_.points[p].size(); ++j) {
        own.push_back(CorrectionMaker(places_[own.size()], frame_rate).run(contacts[p]));
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
  bool set_goals(const std::vector<Correction>& own, Index f, std::vector<JointGoal>& goals) const {
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
  std::vector<Path> places_;  // of each joint of the leg's points, as decoded
};

}  // namespace

void apply_contacts(const Skeleton& skeleton, std::span<const Leg> legs, double frame_rate,
                    std::span<const ContactInterval> contacts, ChannelMatrix& channels) {
  if (contacts.empty() || channels.rows() == 0) return;
  const std::vector<bool> moves = moving_channels(channels);
  int point = 0;
  for (const Leg& leg : legs) {
    std::vector<std::vector<ContactInterval>> own(leg.points.size());
    bool any = false;
    for (std::vector<ContactInterval>& of_point : own) {
      for (const ContactInterval& contact : contacts) {
        if (contact.point == point) of_point.push_back(contact);
      }
      any = any || !of_point.empty();
      ++point;
    }
    LegChain chain(skeleton, leg, moves);
    if (any && chain.can_turn()) LegHolder(chain, leg, channels).hold(own, frame_rate);
  }
}

}  // namespace reprise
