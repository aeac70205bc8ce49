// How alike two stretches of motion are.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "query/posture_track.h"

namespace reprise {

struct LikenessConstants {
  /// A stretch is compared at this many times; a long one at more of them, so that its samples are
  /// at most `longest_step` seconds apart, up to `most_samples`.
  static constexpr int samples = 32;
  static constexpr int most_samples = 128;
  static constexpr double longest_step = 0.4;
  /// Part of a take's median posture that is taken out: bearing is style, not content.
  static constexpr float bearing_taken_out = 0.85f;
  /// mm that a difference of 1 mm/s (or mrad/s) over the ground counts.
  static constexpr float speed_weight = 0.2f;
  /// A bone end counts by this power of how much it moves.
  static constexpr float activity_power = 0.5f;
  /// mm added to a path and to a range before they are compared, so that rest is not noise.
  static constexpr float rest_mm = 30.0f;
};

/// What the terms of a comparison count, found on labelled motions that the published figures do
/// not use (docs/findings/2026-11-25-search.md).
struct LikenessWeights {
  /// mm that a factor e between how often two motions go their own range back and forth counts, in
  /// their courses and in their summaries.
  float course_recurrence;
  float summary_recurrence;
  /// mm that a factor e between two durations counts.
  float course_duration;
  float summary_duration;
  /// In summaries, times what they count in a posture: the means of speeds ahead and to the side,
  /// the mean of turning (which way, and how far), and the deviations of all three (how
  /// unsteadily).
  float summary_speed;
  float summary_turn;
  float summary_unsteadiness;
  /// A comparison counts this part on what sums a motion up, the rest on its postures one by one.
  double summary_part;
};
/// Whole takes: how often limbs go back and forth, how long it takes and which way it turns say
/// more of what is done than single postures.
constexpr LikenessWeights take_weights = {.course_recurrence = 180,
                                          .summary_recurrence = 130,
                                          .course_duration = 40,
                                          .summary_duration = 60,
                                          .summary_speed = 1.4f,
                                          .summary_turn = 2.8f,
                                          .summary_unsteadiness = 0.7f,
                                          .summary_part = 0.75};
/// Parts of a take, which are cut anywhere.
constexpr LikenessWeights part_weights = {.course_recurrence = 90,
                                          .summary_recurrence = 90,
                                          .course_duration = 30,
                                          .summary_duration = 30,
                                          .summary_speed = 1,
                                          .summary_turn = 1,
                                          .summary_unsteadiness = 1,
                                          .summary_part = 2.0 / 3};

constexpr int posture_size = plan_bones * 3 + root_speeds;
using BodyPostures = Eigen::Matrix<float, Eigen::Dynamic, posture_size, Eigen::RowMajor>;
using BoneValues = Eigen::Array<float, plan_bones, 1>;

/// A stretch of a track, in seconds from its first frame.
struct Stretch {
  double begin = 0;
  double end = 0;
  double seconds() const { return end - begin; }
};

/// The postures of a track at `count` times spread evenly over the stretch: places of bone ends
/// over the square root of their number, so that a distance of rows is a root mean square in mm,
/// and weighted speeds. `bearing` is how much of the median posture is taken out.
BodyPostures postures(const PostureTrack& track, const Stretch& stretch, int count, float bearing);

using PostureRow = Eigen::Matrix<float, 1, posture_size>;

/// A motion without its course in time.
struct MotionSummary {
  static constexpr int numbers = 2 * posture_size + plan_bones + 1;
  PostureRow mean;          ///< of the postures, bearing taken out
  PostureRow deviation;     ///< standard deviation of each of their numbers
  BoneValues restlessness;  ///< how often a bone end goes back and forth, as far as it moves at all
  float length = 0;         ///< log of seconds

  /// Side by side, weighted so that a distance of two is one in mm.
  Eigen::Matrix<float, 1, numbers> row(const LikenessWeights& weights) const;
};

/// What is compared of a stretch.
struct MotionForm {
  BodyPostures rows;      ///< bearing taken out
  BoneValues activity;    ///< how much a bone end moves: standard deviation, mm
  BoneValues recurrence;  ///< log of its path over its range
  BoneValues lengths;     ///< of the plan
  double seconds = 0;
  MotionSummary summary;
};
int samples_for(double seconds);
MotionForm motion_form(const PostureTrack& track, const Stretch& stretch, int samples);

/// Both with the same number of samples. A weighted mean (mm) of two distances. One is the root of
/// the sum of squares of the mean distance of postures along the cheapest path of a dynamic time
/// warp, of the difference in how often the bones' ends go back and forth, and in duration. The
/// other is that of their summaries.
double unlikeness(const MotionForm& a, const MotionForm& b, const LikenessWeights& weights);

/// Mean distance (mm) of the bones' ends along the best time alignment, heading and place taken
/// out; bearing and weights do not enter.
double mean_joint_distance(const PostureTrack& a, const Stretch& in_a, const PostureTrack& b,
                           const Stretch& in_b);

}  // namespace reprise
