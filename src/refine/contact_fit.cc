#include "refine/contact_fit.h"

#include <algorithm>
#include <limits>

#include "reprise/model/measure.h"

namespace reprise {
namespace {

using Eigen::Index;
using Constants = ContactFitConstants;

/// A contact that is cut moves what is left of it in another way, which is looked at again so
/// often.
constexpr int most_rounds = 3;

/// Of each joint, the leg that it is turned by, or -1.
std::vector<int> legs_of_joints(const Skeleton& skeleton, const std::vector<Leg>& legs) {
  std::vector<int> result;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const int parent = skeleton.joints[j].parent;
    int own = parent < 0 ? -1 : result[static_cast<std::size_t>(parent)];
    for (std::size_t leg = 0; leg < legs.size(); ++leg) {
      if (std::ranges::find(legs[leg].joints, static_cast<int>(j)) != legs[leg].joints.end()) {
        own = static_cast<int>(leg);
      }
    }
    result.push_back(own);
  }
  return result;
}

/// Of each point of all legs.
std::vector<std::size_t> legs_of_points(const std::vector<Leg>& legs) {
  std::vector<std::size_t> result;
  for (std::size_t leg = 0; leg < legs.size(); ++leg) {
    result.insert(result.end(), legs[leg].points.size(), leg);
  }
  return result;
}

/// Without the units in which `bad`.
void add_rest(const ContactInterval& contact, long unit, const std::vector<bool>& bad,
              std::vector<ContactInterval>& rest) {
  long first = contact.first;
  const auto finish = [&](long end) {
    if (end - first >= Constants::shortest_units * unit) {
      rest.push_back({contact.point, first, end});
    }
  };
  for (long f = contact.first; f < contact.end; f += unit) {
    if (!bad[static_cast<std::size_t>(f / unit)]) continue;
    finish(f);
    first = f + unit;
  }
  finish(contact.end);
}

}  // namespace

ContactFit::ContactFit(const Take& take, const PoseTrack& source, const PoseBounds& bounds,
                       const CodedChannels& plain, const Refinement& refinement)
    : take_(take),
      source_(source),
      bounds_(bounds),
      positions_(positions_of(source)),
      plain_(plain),
      refinement_(refinement),
      poses_(pose_track(*take.skeleton, refinement.decoded)),
      skate_(skate(poses_)),
      legs_(legs_of_joints(*take.skeleton, plain.legs)),
      placed_(legs_.size(), false) {
  for (std::size_t j = 0; j < legs_.size(); ++j) {
    if (legs_[j] < 0) continue;
    for (int k = static_cast<int>(j); k >= 0;
         k = take.skeleton->joints[static_cast<std::size_t>(k)].parent) {
      placed_[static_cast<std::size_t>(k)] = true;
    }
  }
}

std::optional<double> ContactFit::skate(const PoseTrack& poses) const {
  const auto skate = foot_skate(*take_.skeleton, positions_, positions_of(poses), take_.frame_rate);
  if (!skate) return std::nullopt;
  return skate->decoded / std::max(skate->original, std::numeric_limits<double>::min());
}

void ContactFit::hold(const CodedChannels& coded, ChannelMatrix& channels, PoseTrack& poses) const {
  coded.steady_feet(*take_.skeleton, channels);
  const Skeleton& skeleton = *take_.skeleton;
  std::vector<bool> held(static_cast<std::size_t>(take_.frames()), false);
  for (const ContactInterval& contact : coded.contacts.intervals) {
    std::fill(held.begin() + contact.first, held.begin() + contact.end, true);
  }
  std::vector<JointFrame> joints(skeleton.joints.size());
  for (Index f = 0; f < take_.frames(); ++f) {
    if (!held[static_cast<std::size_t>(f)]) continue;
    const std::span<const double> frame(channels.row(f).data(),
                                        static_cast<std::size_t>(channels.cols()));
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (!placed_[j]) continue;
      const Joint& joint = skeleton.joints[j];
      const JointFrame parent =
          joint.parent < 0 ? JointFrame{} : joints[static_cast<std::size_t>(joint.parent)];
      joints[j] = place_joint(skeleton, joint, frame, parent);
      poses[j][static_cast<std::size_t>(f)] = joints[j];
    }
  }
}

bool ContactFit::cut(const PoseTrack& poses, const PoseBounds& limits,
                     TakeContacts& contacts) const {
  const long unit = contact_unit(take_.frame_rate);
  const std::vector<bool> good(static_cast<std::size_t>((take_.frames() + unit - 1) / unit), false);
  std::vector<std::vector<bool>> bad(plain_.legs.size(), good);
  for (std::size_t j = 0; j < legs_.size(); ++j) {
    if (legs_[j] < 0) continue;
    for (std::size_t f = 0; f < poses[j].size(); ++f) {
      const JointFrame &source = source_[j][f], &moved = poses[j][f];
      if (limits.place_ratio(source, moved) <= 1 && limits.turn_ratio(source, moved) <= 1 &&
          (f == 0 || !limits.pops(*take_.skeleton, source_, poses, j, f))) {
        continue;
      }
      bad[static_cast<std::size_t>(legs_[j])][f / static_cast<std::size_t>(unit)] = true;
    }
  }
  const std::vector<std::size_t> legs = legs_of_points(plain_.legs);
  std::vector<ContactInterval> rest;
  for (const ContactInterval& contact : contacts.intervals) {
    add_rest(contact, unit, bad[legs[static_cast<std::size_t>(contact.point)]], rest);
  }
  const bool changed = rest != contacts.intervals;
  contacts.intervals = std::move(rest);
  return changed;
}

void ContactFit::cut_by_source(CodedChannels& coded) const {
  for (int round = 0; round < most_rounds; ++round) {
    ChannelMatrix channels = take_.channels;
    PoseTrack moved = source_;
    hold(coded, channels, moved);
    if (!cut(moved, bounds_.part(Constants::most_moved), coded.contacts)) return;
  }
}

TakeContacts ContactFit::choose() const {
  const TakeContacts all{
      find_contacts(plain_.legs, positions_, take_.frame_rate, take_.skeleton->up), 0};
  if (all.intervals.empty() || !skate_ || *skate_ <= Constants::most_skate_unheld) return {};
  CodedChannels tried = plain_;
  TakeContacts best;
  double least = *skate_;
  for (int hold_index = 0;
       hold_index < 1 << TakeContacts::hold_bits && least > Constants::most_skate; ++hold_index) {
    tried.contacts = {all.intervals, hold_index};
    cut_by_source(tried);
    ChannelMatrix channels = refinement_.decoded;
    PoseTrack poses = poses_;
    hold(tried, channels, poses);
    const auto held = skate(poses);
    if (!held || *held >= least) continue;
    least = *held;
    best = tried.contacts;
  }
  return best;
}

bool ContactFit::pays(const PoseTrack& poses, std::size_t bytes) const {
  const auto held = skate(poses);
  const auto most = Constants::most_bytes * static_cast<double>(refinement_.bytes.size());
  return held && skate_ && *held < *skate_ && static_cast<double>(bytes) <= most;
}

}  // namespace reprise
