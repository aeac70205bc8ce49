#include "query/body_hierarchy.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace reprise {
namespace {

using Eigen::Vector3d;
using K = BodyHierarchyConstants;
using enum BodyJoint;

/// The joints of a limb from the body outwards, each in a place of its own.
struct Limb {
  std::vector<int> joints;
  double length = 0;  ///< from the first joint to the last, mm
};

/// Two equal limbs that begin at one joint.
struct Pair {
  int at = 0;
  Limb first, second;
};

/// The longest of what is looked at in pairs, so that no skeleton takes long.
template <class Part, class Length>
void keep_longest(std::vector<Part>& parts, const Length& length) {
  std::ranges::stable_sort(parts, std::greater<>(), length);
  if (parts.size() > K::most_limbs) parts.resize(K::most_limbs);
}

/// A skeleton as a tree of places.
class RestBody {
 public:
  explicit RestBody(const Skeleton& skeleton)
      : skeleton_(skeleton),
        places_(rest_positions(skeleton)),
        children_(skeleton.joints.size()),
        reach_(skeleton.joints.size(), 0.0) {
    for (std::size_t j = skeleton.joints.size(); j-- > 1;) {
      const int parent = skeleton.joints[j].parent;
      if (parent < 0) continue;
      children_[static_cast<std::size_t>(parent)].insert(
          children_[static_cast<std::size_t>(parent)].begin(), static_cast<int>(j));
      double& reach = reach_[static_cast<std::size_t>(parent)];
      reach = std::max(reach, reach_[j] + apart(static_cast<int>(j), parent));
    }
    longest_ = reach_.empty() ? 0 : *std::ranges::max_element(reach_);
  }

  Vector3d place(int joint) const { return places_.block<1, 3>(0, 3 * joint).transpose(); }
  double apart(int a, int b) const { return (place(a) - place(b)).norm(); }
  bool is_end(int joint) const {
    return skeleton_.joints[static_cast<std::size_t>(joint)].end_site;
  }
  int parent(int joint) const { return skeleton_.joints[static_cast<std::size_t>(joint)].parent; }
  const std::vector<int>& children(int joint) const {
    return children_[static_cast<std::size_t>(joint)];
  }

  bool is_at_or_above(int upper, int lower) const {
    for (; lower >= 0; lower = parent(lower)) {
      if (lower == upper) return true;
    }
    return false;
  }

  /// The longest way down from a joint that hangs from `above`. Joints in the place of the one
  /// before them are left out.
  Limb limb(int joint, int above) const {
    Limb limb;
    int before = above;
    while (true) {
      if (apart(joint, before) > least_bone()) {
        if (!limb.joints.empty()) limb.length += apart(joint, limb.joints.back());
        limb.joints.push_back(joint);
      }
      before = joint;
      const std::vector<int>& below = children(joint);
      if (below.empty()) return limb;
      joint = *std::ranges::max_element(below, {}, [&](int child) {
        return reach_[static_cast<std::size_t>(child)] + apart(child, joint);
      });
    }
  }

  std::vector<Pair> pairs() const {
    std::vector<Pair> found;
    for (int j = 0; j < static_cast<int>(children_.size()); ++j) {
      std::vector<Limb> limbs;
      for (const int child : children(j)) {
        Limb of_child = limb(child, j);
        if (of_child.joints.size() >= 3 && of_child.length >= K::least_limb * longest_) {
          limbs.push_back(std::move(of_child));
        }
      }
      keep_longest(limbs, [](const Limb& limb) { return limb.length; });
      for (std::size_t a = 0; a < limbs.size(); ++a) {
        for (std::size_t b = a + 1; b < limbs.size(); ++b) {
          Pair pair{j, limbs[a], limbs[b]};
          part(pair);
          if (are_equal(pair.first, pair.second)) found.push_back(std::move(pair));
        }
      }
    }
    keep_longest(found, [](const Pair& pair) { return pair.first.length; });
    return found;
  }

 private:
  double least_bone() const { return 1e-3 * longest_; }

  /// Leaves out the joints that both limbs begin with in one place, such as collars.
  void part(Pair& pair) const {
    std::vector<int>& a = pair.first.joints;
    std::vector<int>& b = pair.second.joints;
    while (std::min(a.size(), b.size()) > 3 && apart(a[0], b[0]) <= least_bone()) {
      pair.first.length -= apart(a[0], a[1]);
      pair.second.length -= apart(b[0], b[1]);
      a.erase(a.begin());
      b.erase(b.begin());
    }
  }

  bool are_equal(const Limb& a, const Limb& b) const {
    if (a.joints.size() != b.joints.size()) return false;
    if (apart(a.joints[0], b.joints[0]) <= least_bone()) return false;
    for (std::size_t i = 1; i < a.joints.size(); ++i) {
      const double difference =
          apart(a.joints[i], a.joints[i - 1]) - apart(b.joints[i], b.joints[i - 1]);
      if (std::abs(difference) > K::equal_part * a.length) return false;
    }
    return true;
  }

  const Skeleton& skeleton_;
  PositionMatrix places_;
  std::vector<std::vector<int>> children_;
  std::vector<double> reach_;  ///< the longest way below each joint, mm
  double longest_ = 0;
};

/// Where the two longest neighbouring bones of a limb begin: at the hip, or the shoulder.
std::size_t two_longest_bones(const RestBody& body, const Limb& limb) {
  std::size_t best = 0;
  double longest = -1;
  for (std::size_t i = 0; i + 2 < limb.joints.size(); ++i) {
    const double both = body.apart(limb.joints[i], limb.joints[i + 1]) +
                        body.apart(limb.joints[i + 1], limb.joints[i + 2]);
    if (both > longest) {
      longest = both;
      best = i;
    }
  }
  return best;
}

Vector3d middle(const RestBody& body, int a, int b) { return (body.place(a) + body.place(b)) / 2; }

/// Legs and arms that may belong together.
struct Limbs {
  Pair legs, arms;
  Vector3d up{0, 0, 0};  ///< from the hips to the shoulders, of length 1
};

std::optional<Limbs> upright(const RestBody& body, const Pair& legs, const Pair& arms) {
  if (legs.at == arms.at) return std::nullopt;
  if (!body.is_at_or_above(legs.at, arms.at) && !body.is_at_or_above(arms.at, legs.at)) {
    return std::nullopt;
  }
  const Vector3d hips = middle(body, legs.first.joints.front(), legs.second.joints.front());
  const Vector3d feet = middle(body, legs.first.joints.back(), legs.second.joints.back());
  const Vector3d shoulders = middle(body, arms.first.joints.front(), arms.second.joints.front());
  const Vector3d torso = shoulders - hips, stance = hips - feet;
  // Arms that are held out to both sides end in the middle between them: that is no stance.
  if (torso.norm() < 1e-9 || stance.norm() < legs.first.length / 2) return std::nullopt;
  if (torso.dot(stance) < K::least_upright * torso.norm() * stance.norm()) return std::nullopt;
  return Limbs{legs, arms, torso.normalized()};
}

/// The longest limbs that make a body.
std::optional<Limbs> choose_limbs(const RestBody& body) {
  const std::vector<Pair> pairs = body.pairs();
  std::optional<Limbs> best;
  double longest = 0;
  for (const Pair& legs : pairs) {
    for (const Pair& arms : pairs) {
      const double length = legs.first.length + arms.first.length;
      if (length <= longest) continue;
      if (std::optional<Limbs> limbs = upright(body, legs, arms)) {
        best = std::move(limbs);
        longest = length;
      }
    }
  }
  return best;
}

/// The joints from the shoulders on to the head, which may be above them in the hierarchy.
std::vector<int> way_to_head(const RestBody& body, const Limbs& limbs) {
  const int at = limbs.arms.at;
  std::vector<int> way;
  if (!body.is_at_or_above(limbs.legs.at, at)) {
    for (int j = body.parent(at); j >= 0; j = body.parent(j)) way.push_back(j);
    return way;
  }
  const auto is_arm = [&](int child) {
    return body.is_at_or_above(child, limbs.arms.first.joints.front()) ||
           body.is_at_or_above(child, limbs.arms.second.joints.front());
  };
  double highest = 0;
  for (const int child : body.children(at)) {
    if (is_arm(child)) continue;
    const Limb limb = body.limb(child, at);
    if (limb.joints.empty()) continue;
    const double rise = (body.place(limb.joints.back()) - body.place(at)).dot(limbs.up);
    if (rise > highest) {
      highest = rise;
      way = limb.joints;
    }
  }
  return way;
}

class BodyBuilder {
 public:
  BodyBuilder(const RestBody& body, const Limbs& limbs) : body_(body), limbs_(limbs) {
    match_.joints.fill(-1);
  }

  std::optional<BodyMatch> build() {
    if (!find_sides()) return std::nullopt;
    set_leg(left_leg_, hip_left, knee_left, ankle_left, toe_left);
    set_leg(right_leg_, hip_right, knee_right, ankle_right, toe_right);
    set_arm(left_arm_, shoulder_left, elbow_left, hand_left);
    set_arm(right_arm_, shoulder_right, elbow_right, hand_right);
    set_head();
    if (!match_.is_body()) return std::nullopt;
    return match_;
  }

 private:
  void set(BodyJoint joint, int index) {
    if (index < 0 || body_.is_end(index)) return;
    match_.joints[static_cast<std::size_t>(joint)] = index;
    match_.sources[static_cast<std::size_t>(joint)] = BodySource::hierarchy;
  }

  /// From the ankle to the end of the foot.
  Vector3d foot(const Limb& leg) const {
    const int ankle = leg.joints[two_longest_bones(body_, leg) + 2];
    return body_.place(leg.joints.back()) - body_.place(ankle);
  }

  bool find_sides() {
    Vector3d front = foot(limbs_.legs.first) + foot(limbs_.legs.second);
    front -= front.dot(limbs_.up) * limbs_.up;
    if (front.norm() < 2 * K::least_foot * limbs_.legs.first.length) return false;
    const Vector3d left = limbs_.up.cross(front.normalized());
    return choose(limbs_.legs, left, left_leg_, right_leg_) &&
           choose(limbs_.arms, left, left_arm_, right_arm_);
  }

  bool choose(const Pair& pair, const Vector3d& left, Limb& left_limb, Limb& right_limb) const {
    const Vector3d across =
        body_.place(pair.first.joints.front()) - body_.place(pair.second.joints.front());
    const double to_the_left = across.dot(left);
    if (std::abs(to_the_left) < across.norm() / 2) return false;
    left_limb = to_the_left > 0 ? pair.first : pair.second;
    right_limb = to_the_left > 0 ? pair.second : pair.first;
    return true;
  }

  void set_leg(const Limb& leg, BodyJoint hip, BodyJoint knee, BodyJoint ankle, BodyJoint toe) {
    const std::size_t at = two_longest_bones(body_, leg);
    set(hip, leg.joints[at]);
    set(knee, leg.joints[at + 1]);
    set(ankle, leg.joints[at + 2]);
    if (at + 3 < leg.joints.size()) set(toe, leg.joints[at + 3]);
  }

  void set_arm(const Limb& arm, BodyJoint shoulder, BodyJoint elbow, BodyJoint hand) {
    const std::size_t at = two_longest_bones(body_, arm);
    set(shoulder, arm.joints[at]);
    set(elbow, arm.joints[at + 1]);
    set(hand, arm.joints[at + 2]);
  }

  void set_head() {
    std::vector<int> joints = way_to_head(body_, limbs_);
    // What ends there is the top of the head.
    if (joints.size() > 1) joints.pop_back();
    if (joints.empty()) return;
    set(head, joints.back());
    if (joints.size() > 1) set(neck, joints.front());
  }

  const RestBody& body_;
  const Limbs& limbs_;
  Limb left_leg_, right_leg_, left_arm_, right_arm_;
  BodyMatch match_;
};

}  // namespace

PositionMatrix rest_positions(const Skeleton& skeleton) {
  return joint_positions(skeleton, rest_channels(skeleton));
}

std::optional<BodyMatch> body_by_hierarchy(const Skeleton& skeleton) {
  const RestBody body(skeleton);
  const std::optional<Limbs> limbs = choose_limbs(body);
  if (!limbs) return std::nullopt;
  return BodyBuilder(body, *limbs).build();
}

}  // namespace reprise
