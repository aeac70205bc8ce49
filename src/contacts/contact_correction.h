// What has to be added to the places of a joint so that it stands in its contacts.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "contacts/contact_detection.h"

namespace reprise {

/// 3 x frames, mm.
using JointPath = Eigen::Matrix3Xd;

struct ContactCorrection {
  JointPath offset;           ///< 3 x frames, mm
  std::vector<double> force;  ///< of each frame: 1 in a contact, less beside it, 0 where it ends
};

/// In a contact the joint comes to the mean of its places over `half_mean_s` before and after, cut
/// at the contact's ends; between contacts the offset fades as a smooth curve over
/// `ContactStageConstants::fade_s`. `contacts` are those of one point, in order of time.
ContactCorrection correct_path(const JointPath& places, double frame_rate,
                               std::span<const ContactInterval> contacts, double half_mean_s);

/// In a contact the joint comes to a weighted mean of its places over up to `half_window_s` before
/// and after, the nearer ones weighing more. The window is as wide as the nearer end of the contact
/// allows, so that the offset goes to zero at both, except at an end of the take, where the window
/// is cut. Force grows from 0 at a contact's ends over `ContactStageConstants::settle_s`; outside
/// contacts nothing changes. `contacts` as above.
ContactCorrection steady_path(const JointPath& places, double frame_rate,
                              std::span<const ContactInterval> contacts, double half_window_s);

}  // namespace reprise
