// How a piece of motion is written down before it has a body: key-framed tracks in the mover's own
// frame.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "synth/body.h"

namespace reprise::synth {

/// Columns of a performance. Lengths are shares of the leg's length, angles degrees. Arms are
/// described as left ones: right arms mirror them.
enum Track : int {
  pelvis_x,
  pelvis_rise,  ///< over the height of straight legs
  pelvis_z,
  pelvis_yaw,
  pelvis_pitch,  ///< forward
  pelvis_roll,
  foot_tracks,  ///< two feet of `FootTrack`
  torso_pitch = foot_tracks + 2 * 5,
  torso_twist,
  torso_side,
  head_pitch,
  head_twist,
  head_side,
  arm_tracks,  ///< two arms of `ArmTrack`
  track_count = arm_tracks + 2 * 8
};

/// Where a foot is: under its ankle, as if it stood flat.
enum FootTrack : int { foot_x, foot_z, foot_lift, foot_yaw, foot_pitch };
enum ArmTrack : int { clavicle_y, clavicle_z, arm_x, arm_y, arm_z, elbow, hand_x, hand_z };

constexpr int foot_track(Side side, FootTrack track) {
  return foot_tracks + 5 * static_cast<int>(side) + track;
}
constexpr int arm_track(Side side, ArmTrack track) {
  return arm_tracks + 8 * static_cast<int>(side) + track;
}

/// samples x tracks.
using TrackMatrix = Eigen::Matrix<double, Eigen::Dynamic, track_count, Eigen::RowMajor>;
using TrackRow = Eigen::Matrix<double, 1, track_count>;

/// Half the distance of the feet of someone who stands, in legs.
constexpr double stance_half_width = 0.11;
/// How far the pelvis stands in front of the ankles, in legs.
constexpr double pelvis_before_ankles = 0.04;

/// Someone who stands at the origin, facing +Z, arms down.
TrackRow standing();

struct Key {
  double time = 0;  ///< seconds
  double value = 0;
};

/// amplitude * sin(2 pi frequency (t - from) + phase), between two times.
struct Oscillation {
  double from = 0;
  double to = 0;
  double frequency = 0;  ///< Hz
  double amplitude = 0;
  double phase = 0;  ///< radians
};

/// A motion of a few seconds, sampled at `rate`.
class Performance {
 public:
  static constexpr double rate = 60;

  /// Someone who stands still for `seconds`.
  explicit Performance(double seconds);

  double seconds() const { return static_cast<double>(tracks_.rows() - 1) / rate; }
  long samples() const { return tracks_.rows(); }
  TrackMatrix& tracks() { return tracks_; }
  const TrackMatrix& tracks() const { return tracks_; }

  /// Adds a smooth curve through the keys (monotone cubic: Fritsch and Carlson 1980; no overshoot),
  /// held before the first and after the last.
  void add_keys(int track, std::span<const Key> keys);
  /// Replaces the track by the curve.
  void set_keys(int track, std::span<const Key> keys);
  /// Adds an oscillation with smooth ends.
  void add_oscillation(int track, const Oscillation& oscillation);

  /// The row at a time, between samples by Catmull-Rom.
  TrackRow at(double time) const;

  /// Low-passes the tracks [first, last) with a Gaussian of `sigma` seconds, but for the ends.
  void smooth(int first, int last, double sigma);

 private:
  TrackMatrix tracks_;
};

/// Rises from 0 to 1 as t goes from 0 to 1, at rest at both ends (minimum jerk: Flash and Hogan
/// 1985).
double minimum_jerk(double t);

/// Low-passes a column with a Gaussian of `sigma` samples; the ends are held.
void smooth_column(Eigen::Ref<Eigen::VectorXd> column, double sigma);

}  // namespace reprise::synth
