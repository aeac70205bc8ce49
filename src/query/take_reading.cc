#include "reprise/query/take_reading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "query/body_hierarchy.h"
#include "reprise/model/kinematics.h"
#include "reprise/model/measure.h"
#include "reprise/query/body_joints.h"

namespace reprise {
namespace {

using Eigen::Vector3d;
using K = ReadingConstants;
using enum BodyJoint;

/// Millimetres of metre, decimetre, CMU's unit (0.45 of them are an inch), inch, centimetre and
/// millimetre.
constexpr std::array<double, 6> known_units = {1000.0, 100.0, 25.4 / 0.45, 25.4, 10.0, 1.0};

/// Parts of a body's height (Drillis and Contini 1966, segments of a standing person): without what
/// is below the ankles, and without what is above the joints of head and neck, too.
constexpr double above_ankles = 0.96;
constexpr double ankles_to_head_joint = 0.86, ankles_to_neck_joint = 0.80;
/// What is above the head's joint, as a part of what is below it: else its end is no top of a head.
constexpr double least_head = 0.04, greatest_head = 0.25;

/// Places of joints in one frame.
class Places {
 public:
  Places(const Skeleton& skeleton, const PositionMatrix& positions)
      : skeleton_(skeleton), positions_(positions) {}

  Vector3d of(int joint) const { return positions_.block<1, 3>(0, 3 * joint).transpose(); }
  double apart(int a, int b) const { return (of(a) - of(b)).norm(); }
  int parent(int joint) const { return skeleton_.joints[static_cast<std::size_t>(joint)].parent; }
  Vector3d middle(const std::vector<int>& joints) const {
    Vector3d sum = Vector3d::Zero();
    for (const int joint : joints) sum += of(joint);
    return sum / static_cast<double>(joints.size());
  }

  /// The joint that two joints hang from, or the one that is above the other.
  int common(int a, int b) const {
    while (a != b) {
      int& lower = a > b ? a : b;
      if (parent(lower) < 0) return a < b ? a : b;
      lower = parent(lower);
    }
    return a;
  }

  /// Along the bones from one joint to another, by the joint that both hang from.
  double way(int a, int b) const {
    double length = 0;
    while (a != b) {
      int& lower = a > b ? a : b;
      const int above = parent(lower);
      if (above < 0) break;
      length += apart(lower, above);
      lower = above;
    }
    return length;
  }

 private:
  const Skeleton& skeleton_;
  const PositionMatrix& positions_;
};

/// What is looked at in each frame.
struct Landmarks {
  BodyMatch match;
  std::vector<int> feet, hips, top;  ///< hips: of a body only
  int head_end = -1;
  bool has_height = false;
};

std::vector<int> known_of(const BodyMatch& match, std::initializer_list<BodyJoint> joints) {
  std::vector<int> known;
  for (const BodyJoint joint : joints) {
    if (match.of(joint) >= 0) known.push_back(match.of(joint));
  }
  return known;
}

/// The joint below the head that is furthest from it, by offsets.
int end_of_head(const Skeleton& skeleton, int head_joint) {
  int furthest = -1;
  double longest = 0;
  std::vector<double> way(skeleton.joints.size(), -1.0);
  way[static_cast<std::size_t>(head_joint)] = 0;
  for (std::size_t j = static_cast<std::size_t>(head_joint) + 1; j < way.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    if (joint.parent < 0 || way[static_cast<std::size_t>(joint.parent)] < 0) continue;
    way[j] = way[static_cast<std::size_t>(joint.parent)] + joint.offset.norm();
    if (way[j] > longest) {
      longest = way[j];
      furthest = static_cast<int>(j);
    }
  }
  return furthest;
}

Landmarks find_landmarks(const Skeleton& skeleton) {
  Landmarks marks{match_body(skeleton), {}, {}, {}, -1, false};
  const BodyMatch& match = marks.match;
  const bool legs = match.of(hip_left) >= 0 && match.of(hip_right) >= 0 &&
                    match.of(knee_left) >= 0 && match.of(knee_right) >= 0 &&
                    match.of(ankle_left) >= 0 && match.of(ankle_right) >= 0;
  const int top = match.of(head) >= 0 ? match.of(head) : match.of(neck);
  marks.has_height =
      legs && top >= 0 && (match.of(shoulder_left) >= 0 || match.of(elbow_left) >= 0);
  if (match.of(head) >= 0) marks.head_end = end_of_head(skeleton, match.of(head));
  marks.feet = known_of(match, {ankle_left, ankle_right});
  if (marks.feet.empty()) {
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
      if (is_foot_joint(skeleton.joints[j])) marks.feet.push_back(static_cast<int>(j));
    }
  }
  if (match.is_body()) {
    marks.top = {top};
    marks.hips = known_of(match, {hip_left, hip_right});
  } else {
    // Of an animal the hips are above the feet; its head may be anywhere.
    marks.top = known_of(match, {hip_left, hip_right});
    if (marks.top.empty()) marks.top = {0};
  }
  return marks;
}

/// The height of a body along its bones, in mm of the positions.
double height_of(const Landmarks& marks, const Places& places) {
  const BodyMatch& match = marks.match;
  const double legs = (places.apart(match.of(hip_left), match.of(knee_left)) +
                       places.apart(match.of(knee_left), match.of(ankle_left)) +
                       places.apart(match.of(hip_right), match.of(knee_right)) +
                       places.apart(match.of(knee_right), match.of(ankle_right))) /
                      2;
  const int top = match.of(head) >= 0 ? match.of(head) : match.of(neck);
  const Vector3d hips = places.middle({match.of(hip_left), match.of(hip_right)});
  const int hang = places.common(match.of(hip_left), top);
  // The joint that the legs hang from is near the hips; what is between them counts once.
  const double torso = places.way(hang, top) + (places.of(hang) - hips).norm() / 2;
  const double known = legs + torso;
  if (match.of(head) < 0) return known / ankles_to_neck_joint;
  const double above = marks.head_end < 0 ? 0 : places.way(marks.head_end, match.of(head));
  if (above < least_head * known || above > greatest_head * known) {
    return known / ankles_to_head_joint;
  }
  return (known + above) / above_ankles;
}

Vector3d direction(const Vector3d& from, const Vector3d& to) {
  const double length = (to - from).norm();
  return length > 0 && std::isfinite(length) ? Vector3d((to - from) / length) : Vector3d::Zero();
}

/// Sums of directions of length 1.
struct Uprightness {
  Vector3d head{0, 0, 0};  ///< from the feet to the head
  Vector3d hips{0, 0, 0};  ///< from the feet to the hips
  double straight = 0;     ///< cosines between legs and torso
  long frames = 0;

  void add(const Landmarks& marks, const Places& places) {
    if (marks.feet.empty()) return;
    const Vector3d feet = places.middle(marks.feet), top = places.middle(marks.top);
    const Vector3d to_head = direction(feet, top);
    if (to_head.isZero()) return;
    head += to_head;
    ++frames;
    if (marks.hips.empty()) return;
    const Vector3d middle = places.middle(marks.hips);
    const Vector3d to_hips = direction(feet, middle);
    hips += to_hips;
    straight += to_hips.dot(direction(middle, top));
  }

  /// What goes on four feet carries its head before it. So does who bends down, for a while: legs
  /// have to be upright, and the head must not be.
  Vector3d sum() const {
    const auto count = static_cast<double>(frames);
    const bool on_four_feet = straight < K::least_straight * count &&
                              hips.cwiseAbs().maxCoeff() >= K::least_upright_legs * count &&
                              head.cwiseAbs().maxCoeff() < K::least_upright_rest * count;
    return on_four_feet ? hips : head;
  }
};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

/// The axis that a direction is along by at least a part of its length.
std::optional<UpAxis> axis_along(const Vector3d& direction, double least) {
  Eigen::Index axis = 0;
  if (!(direction.cwiseAbs().maxCoeff(&axis) >= least)) return std::nullopt;
  return static_cast<UpAxis>(axis + (direction[axis] < 0 ? 3 : 0));
}

UpAxis find_up(const Skeleton& skeleton, std::span<const ReadingEvidence> takes) {
  // Sums of whole numbers do not depend on their order.
  constexpr double unit = 1 << 20;
  std::array<std::int64_t, 3> sum{};
  long frames = 0;
  for (const ReadingEvidence& take : takes) {
    for (std::size_t a = 0; a < 3; ++a) {
      sum[a] += std::llround(take.upright[static_cast<Eigen::Index>(a)] * unit);
    }
    frames += take.frames;
  }
  if (frames > 0) {
    const Vector3d mean = Vector3d(static_cast<double>(sum[0]), static_cast<double>(sum[1]),
                                   static_cast<double>(sum[2])) /
                          (unit * static_cast<double>(frames));
    if (const auto up = axis_along(mean, K::least_upright)) return *up;
  }
  const PositionMatrix rest = rest_positions(skeleton);
  const Landmarks marks = find_landmarks(skeleton);
  Uprightness upright;
  upright.add(marks, {skeleton, rest});
  return axis_along(upright.sum(), K::least_upright_rest).value_or(UpAxis::y);
}

double nearest_unit(double height) {
  double best = known_units[0], least = std::numeric_limits<double>::infinity();
  for (const double unit : known_units) {
    const double off = std::abs(std::log(height * unit / K::usual_height_mm));
    if (off < least) {
      least = off;
      best = unit;
    }
  }
  return best;
}

bool is_height(double mm) { return mm >= K::least_height_mm && mm <= K::greatest_height_mm; }

}  // namespace

bool TakeReading::is_plausible() const { return height_mm && is_height(*height_mm); }

ReadingEvidence reading_evidence(const Take& take) {
  const Skeleton& skeleton = *take.skeleton;
  ReadingEvidence evidence;
  if (take.frames() == 0 || skeleton.joints.empty()) return evidence;
  const Landmarks marks = find_landmarks(skeleton);
  std::vector<double> heights;
  Uprightness upright;
  const long stride = (take.frames() + K::most_frames - 1) / K::most_frames;
  for (long f = 0; f < take.frames(); f += stride) {
    const PositionMatrix positions = joint_positions(skeleton, take.channels.middleRows(f, 1));
    const Places places(skeleton, positions);
    if (marks.has_height) heights.push_back(height_of(marks, places));
    upright.add(marks, places);
  }
  evidence.upright = upright.sum();
  evidence.frames = upright.frames;
  if (!heights.empty()) {
    const double height = median(std::move(heights)) / skeleton.millimetres_per_unit;
    if (height > 0 && std::isfinite(height)) evidence.height = height;
  }
  return evidence;
}

TakeReading find_reading(const Skeleton& skeleton, std::span<const ReadingEvidence> takes,
                         const ReadOptions& options) {
  TakeReading reading;
  std::vector<double> heights;
  for (const ReadingEvidence& take : takes) {
    if (take.height) heights.push_back(*take.height);
  }
  reading.millimetres_per_unit = skeleton.millimetres_per_unit;
  if (skeleton.format == MotionFormat::bvh) {
    reading.unit_assumed = !options.bvh_millimetres_per_unit.has_value();
    reading.millimetres_per_unit =
        options.bvh_millimetres_per_unit.value_or(default_millimetres_per_unit);
  }
  if (!heights.empty()) {
    const double height = median(std::move(heights));
    if (reading.unit_assumed && is_height(height * nearest_unit(height))) {
      reading.millimetres_per_unit = nearest_unit(height);
    }
    reading.height_mm = height * reading.millimetres_per_unit;
  }
  reading.up_assumed = !options.up.has_value();
  reading.up = options.up ? *options.up : find_up(skeleton, takes);
  return reading;
}

std::shared_ptr<const Skeleton> read_as(const Skeleton& skeleton, const TakeReading& reading) {
  auto read = std::make_shared<Skeleton>(skeleton);
  read->millimetres_per_unit = reading.millimetres_per_unit;
  read->unit_assumed = reading.unit_assumed;
  read->up = reading.up;
  read->up_assumed = reading.up_assumed;
  return read;
}

void read_as_meant(Take& take, const ReadOptions& options) {
  const ReadingEvidence evidence = reading_evidence(take);
  take.skeleton = read_as(*take.skeleton, find_reading(*take.skeleton, {&evidence, 1}, options));
}

}  // namespace reprise
