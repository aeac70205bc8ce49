#include "query/posture_track.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "ingest/root_alignment.h"
#include "reprise/model/kinematics.h"

namespace reprise {
namespace {

using Eigen::Vector3d;
using K = PostureConstants;

/// A motion at the source's rate (or a part of its frames), on the way to a track.
struct MeasuredMotion {
  double rate = 0;
  std::vector<Vector3d> origin;
  std::vector<double> heading;       ///< radians, without jumps
  std::vector<Vector3d> directions;  ///< frames x bones, heading taken out
  double leg = 0;                    ///< mean of thigh and shin together, mm; 0: none

  long frames() const { return static_cast<long>(origin.size()); }
};

Vector3d turned(const Vector3d& v, double heading) {
  const double c = std::cos(heading), s = std::sin(heading);
  return {c * v.x() - s * v.z(), v.y(), s * v.x() + c * v.z()};
}

/// `angle` moved by whole turns to be nearest to `previous`.
double continued(double angle, double previous) {
  return angle + 2 * std::numbers::pi * std::round((previous - angle) / (2 * std::numbers::pi));
}

double leg_length(const MeasuredBody& body, const std::vector<JointFrame>& joints) {
  if (body.plan.id != 0) return 0;
  const auto place = [&](BodyJoint j) {
    return joints[static_cast<std::size_t>(body.joints[static_cast<std::size_t>(j)])].position;
  };
  using enum BodyJoint;
  return ((place(hip_left) - place(knee_left)).norm() +
          (place(hip_right) - place(knee_right)).norm() +
          (place(knee_left) - place(ankle_left)).norm() +
          (place(knee_right) - place(ankle_right)).norm()) /
         2;
}

void measure_frame(const MeasuredBody& body, const std::vector<JointFrame>& joints,
                   MeasuredMotion& motion) {
  const JointFrame& left = joints[static_cast<std::size_t>(body.left)];
  const JointFrame& right = joints[static_cast<std::size_t>(body.right)];
  const Vector3d origin = (left.position + right.position) / 2;
  const double previous = motion.heading.empty() ? 0.0 : motion.heading.back();
  double heading = previous;
  if (body.left == body.right) {
    heading = continued(-heading_of(left.rotation), previous);
  } else {
    // Hips above each other tell no heading: the one before goes on.
    const Vector3d across = left.position - right.position;
    if (std::hypot(across.x(), across.z()) > 1e-3 * across.norm()) {
      heading = continued(std::atan2(across.z(), across.x()), previous);
    }
  }
  motion.origin.push_back(origin);
  motion.heading.push_back(heading);
  motion.leg += leg_length(body, joints);
  for (std::size_t b = 0; b < plan_bones; ++b) {
    Vector3d direction = Vector3d::Zero();
    if (body.joints[b] >= 0) {
      // The nearest bone above that the skeleton has.
      int parent = body.plan.parents[b];
      while (parent >= 0 && body.joints[static_cast<std::size_t>(parent)] < 0) {
        parent = body.plan.parents[static_cast<std::size_t>(parent)];
      }
      const Vector3d from =
          parent < 0
              ? origin
              : joints[static_cast<std::size_t>(body.joints[static_cast<std::size_t>(parent)])]
                    .position;
      direction = joints[static_cast<std::size_t>(body.joints[b])].position - from;
      const double length = direction.norm();
      direction = length > 1e-6 ? turned(direction / length, -heading) : Vector3d::Zero();
    }
    motion.directions.push_back(direction);
  }
}

MeasuredMotion measure(const Take& take, const MeasuredBody& body) {
  const long stride = std::max(1L, static_cast<long>(take.frame_rate / K::least_source_rate));
  MeasuredMotion motion;
  motion.rate = take.frame_rate / static_cast<double>(stride);
  std::vector<JointFrame> joints(take.skeleton->joints.size());
  const Eigen::Matrix3d to_y = turn_to_y(take.skeleton->up);
  for (long f = 0; f < take.frames(); f += stride) {
    forward_kinematics(
        *take.skeleton,
        {take.channels.row(f).data(), static_cast<std::size_t>(take.channels.cols())}, joints);
    for (JointFrame& joint : joints) {
      joint = {to_y * joint.rotation * to_y.transpose(), to_y * joint.position};
    }
    measure_frame(body, joints, motion);
  }
  motion.leg /= static_cast<double>(motion.frames());
  return motion;
}

template <typename Integer>
Integer rounded(double value) {
  constexpr double most = std::numeric_limits<Integer>::max();
  return static_cast<Integer>(std::lround(std::clamp(value, -most, most)));
}

void add_directions(const MeasuredMotion& motion, double time, PostureTrack& track) {
  const long last = motion.frames() - 1;
  const double half = K::smoothing / 2 * motion.rate;
  const double middle = time * motion.rate;
  const long nearest = std::clamp(std::lround(middle), 0L, last);
  const long begin = std::clamp(static_cast<long>(std::ceil(middle - half)), 0L, nearest);
  const long end = std::clamp(static_cast<long>(std::floor(middle + half)), nearest, last) + 1;
  for (long b = 0; b < plan_bones; ++b) {
    Vector3d sum = Vector3d::Zero();
    for (long f = begin; f < end; ++f) {
      sum += motion.directions[static_cast<std::size_t>(f * plan_bones + b)];
    }
    for (int axis = 0; axis < 3; ++axis) {
      track.directions.push_back(rounded<std::int8_t>(double{K::direction_unit} * sum[axis] /
                                                      static_cast<double>(end - begin)));
    }
  }
}

void add_speeds(const MeasuredMotion& motion, double time, PostureTrack& track) {
  const long last = motion.frames() - 1;
  const double half = K::speed_span / 2 * motion.rate;
  const double middle = time * motion.rate;
  const long begin = std::clamp(std::lround(middle - half), 0L, last);
  const long end = std::clamp(std::lround(middle + half), 0L, last);
  if (begin == end) {
    track.speeds.insert(track.speeds.end(), root_speeds, 0);
    return;
  }
  const auto at = [](const auto& values, long f) { return values[static_cast<std::size_t>(f)]; };
  const double seconds = static_cast<double>(end - begin) / motion.rate;
  const double scale = motion.leg > 0 ? K::reference_leg / motion.leg : 1.0;
  const double heading = at(motion.heading, std::clamp(std::lround(middle), 0L, last));
  const Vector3d step =
      turned(at(motion.origin, end) - at(motion.origin, begin), -heading) * (scale / seconds);
  const double turn = (at(motion.heading, end) - at(motion.heading, begin)) / seconds;
  track.speeds.push_back(rounded<std::int16_t>(step.x()));
  track.speeds.push_back(rounded<std::int16_t>(step.z()));
  track.speeds.push_back(rounded<std::int16_t>(1000 * turn));
}

void set_median(PostureTrack& track) {
  const std::size_t frames = static_cast<std::size_t>(track.frames());
  std::vector<std::int8_t> column(frames);
  for (std::size_t i = 0; i < track.median.size(); ++i) {
    for (std::size_t f = 0; f < frames; ++f) {
      column[f] = track.directions[f * track.median.size() + i];
    }
    const auto middle = column.begin() + static_cast<std::ptrdiff_t>(frames / 2);
    std::nth_element(column.begin(), middle, column.end());
    track.median[i] = *middle;
  }
}

}  // namespace

PostureTrack posture_track(const Take& take, const JointMap& map) {
  assert(take.frames() > 0);
  const MeasuredBody body = measured_body(*take.skeleton, map);
  const MeasuredMotion motion = measure(take, body);
  PostureTrack track;
  track.plan = body.plan;
  const double length = static_cast<double>(motion.frames() - 1) / motion.rate;
  const long frames = static_cast<long>(std::floor(length * K::rate + 1e-6)) + 1;
  track.directions.reserve(static_cast<std::size_t>(frames * plan_bones * 3));
  track.speeds.reserve(static_cast<std::size_t>(frames * root_speeds));
  for (long f = 0; f < frames; ++f) {
    add_directions(motion, static_cast<double>(f) / K::rate, track);
    add_speeds(motion, static_cast<double>(f) / K::rate, track);
  }
  set_median(track);
  return track;
}

void bone_ends(const BodyPlan& plan, const float* directions, float* ends) {
  for (int b = 0; b < plan_bones; ++b) {
    const int parent = plan.parents[static_cast<std::size_t>(b)];
    for (int axis = 0; axis < 3; ++axis) {
      const float from = parent < 0 ? 0.0f : ends[3 * parent + axis];
      ends[3 * b + axis] =
          from + plan.lengths[static_cast<std::size_t>(b)] * directions[3 * b + axis];
    }
  }
}

}  // namespace reprise
