// How still the feet of a take stand: as still as those of its source.
#pragma once

#include <span>

#include "contacts/contact_detection.h"
#include "reprise/model/take.h"

namespace reprise {

struct ContactChoiceConstants {
  /// Part of the source's foot skate that may be left at the step at hand: less than all of it,
  /// since the step that is found in the end can be a little coarser.
  static constexpr double most_skate = 0.9;
  /// Feet that slide this much less or more than the source's need not be held.
  static constexpr double most_skate_unheld = 1.05;
  /// Part of the mean error without contacts that there may be with them: where the curves are
  /// finer than the source's own slides, holding would cost error.
  static constexpr double most_error = 1.1;
};

/// Contacts of the source's positions (frames x 3*joints, mm), and the loosest hold with which
/// `decoded` keeps foot skate (docs/measures.md) below that part of the source's, else the
/// tightest. Feet that the measure does not know of get a hold in between. None where they are not
/// needed or cost too much error.
TakeContacts choose_contacts(const Skeleton& skeleton, const std::vector<Leg>& legs,
                             double frame_rate, const PositionMatrix& source,
                             const ChannelMatrix& decoded);

}  // namespace reprise
