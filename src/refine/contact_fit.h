// Which contacts a bounded take is decoded with.
#pragma once

#include <optional>

#include "refine/coded_channels.h"
#include "refine/pose_bounds.h"
#include "refine/refinement.h"
#include "reprise/model/kinematics.h"
#include "reprise/model/take.h"

namespace reprise {

struct ContactFitConstants {
  /// Part of the source's foot skate that may be left before steps are made finer and contacts
  /// shorter, which changes it by a few per cent.
  static constexpr double most_skate = 1.03;
  /// Feet that slide this much less or more than the source's need no contacts.
  static constexpr double most_skate_unheld = 1.05;
  /// Part of the bound that a joint of the source itself may move by when its feet are held: what
  /// is left is for the coder.
  static constexpr double most_moved = 0.8;
  /// A shorter contact is none.
  static constexpr long shortest_units = 2;
  /// A take that contacts make larger than this part of itself goes without.
  static constexpr double most_bytes = 1.2;
};

class ContactFit {
 public:
  /// `source` is the take's; keeps references to both. `bounds` are what joints keep; `plain` and
  /// `refinement` are the take without contacts, which have to stay.
  ContactFit(const Take& take, const PoseTrack& source, const PoseBounds& bounds,
             const CodedChannels& plain, const Refinement& refinement);

  /// The contacts and the loosest hold with which feet slide as little as the source's (foot skate,
  /// docs/measures.md), else those with which they slide least. None where feet do so anyway, or
  /// nothing is known of them.
  TakeContacts choose() const;

  /// Holds feet in channels that are at `poses` without, and moves these.
  void hold(const CodedChannels& coded, ChannelMatrix& channels, PoseTrack& poses) const;

  /// Ends contacts of legs in the units of time in which a joint of the leg is further from the
  /// source than `limits`; true if there were such contacts.
  bool cut(const PoseTrack& poses, const PoseBounds& limits, TakeContacts& contacts) const;

  /// True if what is at `poses` in so many bytes slides less than without contacts, and is not
  /// much larger.
  bool pays(const PoseTrack& poses, std::size_t bytes) const;

 private:
  /// Foot skate by foot skate of the source; none without feet or contacts.
  std::optional<double> skate(const PoseTrack& poses) const;
  /// Leaves out what would move the source itself too far.
  void cut_by_source(CodedChannels& coded) const;

  const Take& take_;
  const PoseTrack& source_;
  PoseBounds bounds_;
  PositionMatrix positions_;  ///< of the source, frames x 3*joints, mm
  const CodedChannels& plain_;
  const Refinement& refinement_;
  PoseTrack poses_;  ///< of `refinement_`
  std::optional<double> skate_;
  std::vector<int> legs_;     ///< of each joint: the leg that it is turned by, or -1
  std::vector<bool> placed_;  ///< of each joint: a leg's, or above one
};

}  // namespace reprise
