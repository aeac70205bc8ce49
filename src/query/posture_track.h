// A motion as postures that bodies of all skeletons share: directions of bones at 10 Hz, heading
// and place taken out, and how the body moves over the ground. This is what search compares.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "reprise/model/take.h"
#include "reprise/query/body_joints.h"

namespace reprise {

struct PostureConstants {
  /// Postures a second; whole takes are compared in 32 samples, so that more gain nothing.
  static constexpr double rate = 10.0;
  /// Directions are means over this time (s), against noise and against what coding adds.
  static constexpr double smoothing = 1.0 / 6;
  /// Speeds are differences over this time (s).
  static constexpr double speed_span = 0.3;
  /// Frames of higher rates are left out, down to this many a second.
  static constexpr double least_source_rate = 30.0;
  static constexpr float direction_unit = 127.0f;  ///< of a stored direction of length 1
  /// Thigh and shin of the body that all are measured on (mm): speeds scale with the legs.
  static constexpr double reference_leg = 830.0;
};

constexpr int plan_bones = static_cast<int>(body_joint_count);
constexpr int root_speeds = 3;  ///< to the side and ahead (mm/s), turning (mrad/s)

/// Which bones there are. Only motions of the same plan can be compared.
struct BodyPlan {
  std::uint64_t id = 0;  ///< 0: the bones of BodyJoint; else of one skeleton
  std::array<std::int8_t, plan_bones> parents{};  ///< the bone before it, or -1: from the origin
  std::array<float, plan_bones> lengths{};        ///< mm; 0: the skeleton does not have it

  friend bool operator==(const BodyPlan&, const BodyPlan&) = default;
};

/// A plan and where its bones are in a skeleton.
struct MeasuredBody {
  BodyPlan plan;
  std::array<int, plan_bones> joints{};  ///< far end of each bone, or -1
  int left = 0, right = 0;  ///< the origin is between them; the same: heading is that joint's
};

/// The common body (bones with the lengths of one reference body, so that proportions do not
/// matter) where the joints match one, else a plan of the skeleton's own longest bones.
MeasuredBody measured_body(const Skeleton& skeleton, const JointMap& map = {});

struct PostureTrack {
  BodyPlan plan;
  std::vector<std::int8_t> directions;  ///< frames x bones x 3: unit vectors x 127, averaged
  std::vector<std::int16_t> speeds;     ///< frames x root_speeds
  std::array<std::int8_t, plan_bones * 3> median{};  ///< of each direction over the track

  long frames() const { return static_cast<long>(speeds.size()) / root_speeds; }
  double seconds() const { return static_cast<double>(frames()) / PostureConstants::rate; }
};

/// Of a take with at least one frame.
PostureTrack posture_track(const Take& take, const JointMap& map = {});

/// Places (mm) of the ends of the plan's bones from their directions.
void bone_ends(const BodyPlan& plan, const float* directions, float* ends);

}  // namespace reprise
