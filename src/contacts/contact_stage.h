// Puts feet where they stand (Lin 2011, section 5.3), on the decoded motion.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "contacts/contact_detection.h"
#include "reprise/model/take.h"

namespace reprise {

struct ContactStageConstants {
  /// A point is held at the mean of its decoded places over this long before and after, so that it
  /// follows the body as it drifts, or at the mean of the contact. A take has one of these.
  static constexpr std::array<double, 1 << TakeContacts::hold_bits> half_means_s = {
      0.25, 0.5, 1.0, std::numeric_limits<double>::infinity()};
  /// What a contact changes is let go over this long.
  static constexpr double fade_s = 0.1;
  /// Where a bound holds, a point's path is smoothed over this long before and after instead; a
  /// take has one of these.
  static constexpr std::array<double, 1 << TakeContacts::hold_bits> half_windows_s = {0.05, 0.1,
                                                                                      0.3, 2.0};
  /// Smoothing is in full force this long after a contact begins and before it ends.
  static constexpr double settle_s = 0.1;
  /// Weight of a point that does not stand, beside 1 of one that does.
  static constexpr double free_weight = 0.02;
};

/// Which channels are not the same in all frames.
std::vector<bool> moving_channels(const ChannelMatrix& channels);

/// Turns the legs of a decoded take so that points stay where they stand during contacts. Nothing
/// but rotation channels of legs with `moves` (one a channel of a frame) changes, in contacts and
/// the fades beside them. A leg that is too short reaches as far as it can. `legs` are those that
/// the contacts were found with, of this skeleton or of one of the same structure;
/// `contacts.intervals` as find_contacts gives them.
void apply_contacts(const Skeleton& skeleton, std::span<const Leg> legs, double frame_rate,
                    const TakeContacts& contacts, const std::vector<bool>& moves,
                    ChannelMatrix& channels);

/// The same for a motion that is within a few millimetres of its source, and changes it by less:
/// points move as steadily as the source's in contacts, and nothing changes outside them.
void steady_contacts(const Skeleton& skeleton, std::span<const Leg> legs, double frame_rate,
                     const TakeContacts& contacts, const std::vector<bool>& moves,
                     ChannelMatrix& channels);

}  // namespace reprise
