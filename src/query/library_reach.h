// Up to which distance a motion is a repeat of another, in what search compares.
#pragma once

#include <vector>

#include "query/likeness.h"

namespace reprise {

/// How far the postures of a library are from one another, as PostureLibrary::follow_reach has it,
/// on bodies of one size.
class LibraryReach {
 public:
  /// Of tracks of one plan. Large libraries are judged by about a thousand of their postures,
  /// evenly spread.
  explicit LibraryReach(const std::vector<const PostureTrack*>& tracks);

  /// Up to which distance (mm, that of `mean_joint_distance`) something repeats this stretch of a
  /// track of the same plan: the limit of `repeats` for a part that is asked for.
  double repeat_limit(const PostureTrack& track, const Stretch& stretch) const;

 private:
  BodyPostures sample_;
};

/// How large a motion is: mean distance (mm) of the bones' ends to their mean places.
double motion_size(const PostureTrack& track, const Stretch& stretch);

}  // namespace reprise
