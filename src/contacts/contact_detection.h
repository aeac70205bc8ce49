// When feet stand on the floor (Lin 2011, section 5.3).
#pragma once

#include <vector>

#include "contacts/legs.h"
#include "reprise/model/kinematics.h"

namespace reprise {

/// Thresholds are those of the foot skate measure (FootContact): a foot that is slower slides
/// visibly when the decoded one does not hold. The paper's 2.5 cm a frame of 120 Hz, 3 m/s, holds
/// feet that swing.
struct ContactConstants {
  static constexpr double unit_s = 1.0 / 30.0;   ///< contacts begin and end on multiples of it
  static constexpr long shortest_units = 2;      ///< a shorter contact is none
  static constexpr long shortest_gap_units = 2;  ///< a shorter gap between two contacts is none
};

/// A point of a leg stands in frames `first` .. `end` - 1.
struct ContactInterval {
  int point = 0;  ///< index among all points of all legs (legs.h)
  long first = 0;
  long end = 0;

  bool operator==(const ContactInterval&) const = default;
};

/// All contacts of a take.
struct TakeContacts {
  static constexpr int hold_bits = 2;

  std::vector<ContactInterval> intervals;  ///< as find_contacts gives them
  /// How still points stand: index of ContactStageConstants::half_means_s, or half_windows_s.
  int hold = 0;

  bool operator==(const TakeContacts&) const = default;
};

/// Frames a unit of time, at least 1.
long contact_unit(double frame_rate);

/// Contacts of a take from its positions (frames x 3*joints, mm; heights along `up_axis`), by point
/// and then by time; those
/// of a point do not touch each other. Both ends are multiples of contact_unit, but for the end of
/// the take.
std::vector<ContactInterval> find_contacts(const std::vector<Leg>& legs,
                                           const PositionMatrix& positions, double frame_rate,
                                           UpAxis up_axis);

}  // namespace reprise
