#include "reprise/model/measure.h"

#include <algorithm>
#include <cmath>

#include "model/foot_contact.h"
#include "model/up_direction.h"
#include "reprise/error.h"

namespace reprise {
namespace {

using Eigen::Index;

/// Of a take that foot skate is measured of.
constexpr Index least_frames = 8;
constexpr double rounding = 1e-12;

/// The p-th percentile of sorted numbers, between neighbours in a straight line.
template <class Number>
double percentile(const std::vector<Number>& sorted, double p) {
  const double at = p / 100.0 * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double part = at - static_cast<double>(below);
  return static_cast<double>(sorted[below]) * (1 - part) +
         static_cast<double>(sorted[above]) * part;
}

bool names_foot(std::string lower) {
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower.find("foot") != std::string::npos || lower.find("toe") != std::string::npos ||
         lower.find("ankle") != std::string::npos;
}

/// Horizontal speed (mm/s) of a joint over 2h frames around frame f.
double horizontal_speed(const UpDirection& up, const PositionMatrix& positions, int joint, Index f,
                        Index h, double rate) {
  return up.step(positions, joint, f - h, f + h) * rate / (2.0 * static_cast<double>(h));
}

double d_percent(const PositionMatrix& original, const PositionMatrix& decoded, Index frames) {
  const auto a = original.topRows(frames);
  const double moved = (a.rowwise() - a.colwise().mean()).norm();
  // The mean of equal numbers is off by some rounding, which is no motion.
  return moved > rounding * a.norm() ? 100.0 * (a - decoded.topRows(frames)).norm() / moved : 0.0;
}

/// Throws Error (failed) where joints or frames have no counterparts.
void require_comparable(const Take& original, const Take& decoded) {
  const auto& joints = original.skeleton->joints;
  const auto& others = decoded.skeleton->joints;
  if (joints.size() != others.size()) {
    throw Error(ErrorCode::failed,
                "the two motions have different skeletons: " + std::to_string(joints.size()) +
                    " and " + std::to_string(others.size()) + " joints");
  }
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].parent == others[j].parent) continue;
    throw Error(ErrorCode::failed, "the two motions have different skeletons: '" + joints[j].name +
                                       "' and '" + others[j].name + "' hang at different joints");
  }
  if (original.frames() == 0 || decoded.frames() == 0) {
    throw Error(ErrorCode::failed, std::string("the ") +
                                       (original.frames() == 0 ? "original" : "decoded") +
                                       " motion has no frames");
  }
}

}  // namespace

bool is_foot_joint(const Joint& joint) { return names_foot(joint.name); }

std::vector<float> joint_distances(const PositionMatrix& original, const PositionMatrix& decoded) {
  const Index frames = std::min(original.rows(), decoded.rows());
  const Index joints = original.cols() / 3;
  std::vector<float> distances;
  distances.reserve(static_cast<std::size_t>(frames * joints));
  for (Index f = 0; f < frames; ++f) {
    for (Index j = 0; j < joints; ++j) {
      distances.push_back(static_cast<float>(
          (original.row(f).segment<3>(3 * j) - decoded.row(f).segment<3>(3 * j)).norm()));
    }
  }
  return distances;
}

PositionErrors summarise_distances(std::vector<float>& distances) {
  PositionErrors errors;
  if (distances.empty()) return errors;
  std::sort(distances.begin(), distances.end());
  double sum = 0, squares = 0;
  for (const float distance : distances) {
    sum += distance;
    squares += static_cast<double>(distance) * distance;
  }
  const auto count = static_cast<double>(distances.size());
  errors.mean = sum / count;
  errors.rms = std::sqrt(squares / count);
  errors.p99 = percentile(distances, 99);
  errors.max = distances.back();
  return errors;
}

PositionErrors position_errors(const PositionMatrix& original, const PositionMatrix& decoded) {
  std::vector<float> distances = joint_distances(original, decoded);
  return summarise_distances(distances);
}

std::optional<FootSkate> foot_skate(const Skeleton& skeleton, const PositionMatrix& original,
                                    const PositionMatrix& decoded, double frame_rate) {
  const Index frames = std::min(original.rows(), decoded.rows());
  std::vector<int> feet;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (is_foot_joint(skeleton.joints[j])) feet.push_back(static_cast<int>(j));
  }
  if (feet.empty() || frames < least_frames) return std::nullopt;
  // Halves go to the even number.
  const Index h = std::max<Index>(1, std::lrint(FootContact::half_window_s * frame_rate));
  const UpDirection up(skeleton.up);
  std::vector<double> heights;
  for (const int joint : feet) {
    for (Index f = 0; f < frames; ++f) heights.push_back(up.height(original, f, joint));
  }
  std::sort(heights.begin(), heights.end());
  const double floor = percentile(heights, FootContact::floor_percentile);
  double in_original = 0, in_decoded = 0;
  long contacts = 0;
  for (const int joint : feet) {
    for (Index f = h; f + h < frames; ++f) {
      const double speed = horizontal_speed(up, original, joint, f, h, frame_rate);
      const bool touches = up.height(original, f, joint) < floor + FootContact::height_mm;
      if (!touches || speed >= FootContact::speed_mm_s) continue;
      in_original += speed;
      in_decoded += horizontal_speed(up, decoded, joint, f, h, frame_rate);
      ++contacts;
    }
  }
  if (contacts == 0) return std::nullopt;
  return FootSkate{in_original / static_cast<double>(contacts),
                   in_decoded / static_cast<double>(contacts)};
}

Comparison compare_takes(const Take& original, const Take& decoded) {
  require_comparable(original, decoded);
  const PositionMatrix a = joint_positions(*original.skeleton, original.channels);
  const PositionMatrix b = joint_positions(*decoded.skeleton, decoded.channels);
  Comparison result;
  result.frames = std::min(a.rows(), b.rows());
  result.missing_frames = std::max(a.rows(), b.rows()) - result.frames;
  MotionDistances distances = motion_distances(*original.skeleton, original.channels,
                                               decoded.channels, true, decoded.skeleton.get());
  const MotionErrors errors = summarise_motion(distances, original.skeleton->joints.size());
  result.errors = errors.places;
  result.turns = errors.turns;
  result.local_turns = summarise_turns(distances.local_turns);
  result.worst_place = errors.worst_place;
  result.worst_turn = errors.worst_turn;
  result.d_percent = d_percent(a, b, result.frames);
  result.foot_skate = foot_skate(*original.skeleton, a, b, original.frame_rate);
  return result;
}

}  // namespace reprise
