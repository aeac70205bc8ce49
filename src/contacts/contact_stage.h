// Puts feet where they stand (Lin 2011, section 5.3), on the decoded motion.
#pragma once

#include <array>
#include <limits>
#include <span>

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
  /// Weight of a point that does not stand, beside 1 of one that does.
  static constexpr double free_weight = 0.02;
};

/// Turns the legs of a decoded take so that points stay where they stand during contacts. Nothing
/// but rotation channels of legs changes, in contacts and the fades beside them. A leg that is too
/// short reaches as far as it can. `legs` are those that the contacts were found with, of this
/// skeleton or of one of the same structure; `contacts.intervals` as find_contacts gives
/// them.
void apply_contacts(const Skeleton& skeleton, std::span<const Leg> legs, double frame_rate,
                    const TakeContacts& contacts, ChannelMatrix& channels);

}  // namespace reprise
