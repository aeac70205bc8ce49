// How the numbers of a motion file are meant where nobody says it: which axis points up, and how
// long a unit of length is.
#pragma once

#include <optional>
#include <span>

#include "reprise/formats/motion_file.h"
#include "reprise/model/take.h"

namespace reprise {

/// What a user may say of a file. Beyond these no mocap file makes sense; they also keep products
/// of times and rates in range. The least are their reciprocals.
struct ReadingLimits {
  static constexpr double greatest_unit_mm = 1e6, greatest_frame_rate = 1e5;
};

struct ReadingConstants {
  /// What a body is most likely as tall as, and what one may be (mm).
  static constexpr double usual_height_mm = 1700;
  static constexpr double least_height_mm = 900, greatest_height_mm = 2300;
  /// Frames that a take is looked at in, at most.
  static constexpr long most_frames = 200;
  /// The part of the way from feet to head that has to be along one axis, on average over all
  /// frames, for the motion to say which one points up; and the same of the rest pose.
  static constexpr double least_upright = 0.55;
  static constexpr double least_upright_rest = 0.8;
  /// Of what goes on four feet: the cosine of the angle between legs and torso is less on average,
  /// and the legs are along one axis by more.
  static constexpr double least_straight = 0.5, least_upright_legs = 0.9;
};

/// What one take says of how its numbers are meant, in its file's own units and axes.
struct ReadingEvidence {
  /// The height of the body along its bones, as if it stood straight; none if it is no body.
  std::optional<double> height;
  Eigen::Vector3d upright{0, 0, 0};  ///< sum over frames of directions from feet to head or, of
                                     ///< what goes on four feet, to the hips
  long frames = 0;                   ///< that `upright` is a sum over
};

/// Of a take with any reading.
ReadingEvidence reading_evidence(const Take& take);

/// How the takes of one skeleton text are to be read.
struct TakeReading {
  double millimetres_per_unit = default_millimetres_per_unit;
  bool unit_assumed = false;
  UpAxis up = UpAxis::y;
  bool up_assumed = false;
  /// Of the body in that unit, mm; none if it is no body.
  std::optional<double> height_mm;

  /// The height is one that a body may have.
  bool is_plausible() const;
};

/// The unit of a BVH is the one of metre, decimetre, centimetre, inch, millimetre and CMU's unit
/// (56.444 mm) that brings the median height of `takes` nearest to a usual one, on a logarithmic
/// scale; 10 mm where there is no body, or none of them makes a plausible one. An ASF says its
/// unit. Up is the axis that heads are above feet along, over the motion of all takes, else in the
/// rest pose, else Y. What `options` say comes first. Does not depend on the order of `takes`.
TakeReading find_reading(const Skeleton& skeleton, std::span<const ReadingEvidence> takes,
                         const ReadOptions& options);

/// The skeleton, read that way.
std::shared_ptr<const Skeleton> read_as(const Skeleton& skeleton, const TakeReading& reading);

/// Gives a take that was just read the reading that it says itself.
void read_as_meant(Take& take, const ReadOptions& options);
/// Gives it the reading of takes with the same skeleton text in an archive, else its own.
void read_as_stored(Take& take, const ReadOptions& options, const std::filesystem::path& archive);

}  // namespace reprise
