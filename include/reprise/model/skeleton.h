// The skeleton of a take: joints, their hierarchy, proportions and channels.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reprise {

/// Persisted in archives: never change a value.
enum class MotionFormat : std::uint8_t { bvh = 1, asf_amc = 2 };

/// What one number of a frame means. Persisted in archives: never change a value.
enum class Channel : std::uint8_t {
  x_position = 0,
  y_position = 1,
  z_position = 2,
  x_rotation = 3,
  y_rotation = 4,
  z_rotation = 5,
  length = 6,  ///< ASF `l`: stretch along the bone
};

constexpr bool is_rotation(Channel channel) {
  return channel >= Channel::x_rotation && channel <= Channel::z_rotation;
}
constexpr bool is_position(Channel channel) { return channel <= Channel::z_position; }
/// 0, 1, 2 for X, Y, Z; of position and rotation channels only.
constexpr int axis_of(Channel channel) { return static_cast<int>(channel) % 3; }

/// A joint (BVH: joint or end site; ASF: root or bone) and the one point that it stands for.
///
/// With R_parent, P_parent the world orientation and place of the parent, E the product of the
/// rotation channels in `rotation_order` and A the matrix of `axis`:
///   R = R_parent A E A^T
///   BVH: P = P_parent + R_parent t, t = `offset` with the components replaced that have a position
///        channel. The joint turns about P itself.
///   ASF: P = P_parent + R_parent A t + R (`offset` + l * unit(offset)), t the position channels, l
///   the
///        length channel. A bone turns about its parent's point, and P is the bone's far end. The
///        root's position channels add to `offset`, as in the format's description.
struct Joint {
  std::string name;                 ///< an end site has the name "" and no channels
  int parent = -1;                  ///< index of the parent; parents come before their children
  Eigen::Vector3d offset{0, 0, 0};  ///< in the file's length unit
  std::vector<Channel> channels;    ///< in the order of the file's numbers
  std::vector<int>
      rotation_order;  ///< axes 0..2 of the rotation channels, outermost (leftmost) first
  std::vector<int> rotation_slots;                     ///< of each of them: its index in `channels`
  Eigen::Matrix3d axis = Eigen::Matrix3d::Identity();  ///< ASF: the bone's local axes C
  bool end_site = false;
  int first_channel = 0;  ///< index of the first of `channels` in a frame
};

/// The direction of the world's axes that points away from the ground. Persisted in archives: never
/// change a value.
enum class UpAxis : std::uint8_t { x = 0, y = 1, z = 2, minus_x = 3, minus_y = 4, minus_z = 5 };

/// "x", "y", "z", "-x", "-y" or "-z".
std::string_view up_axis_name(UpAxis up);
/// The axis of such a name, in any case, or none.
std::optional<UpAxis> find_up_axis(std::string_view name);

/// BVH does not say its unit; centimetres are the most common one.
constexpr double default_millimetres_per_unit = 10.0;

/// Joints in file order (hierarchy first, depth first for BVH; root and then `:hierarchy` order for
/// ASF).
struct Skeleton {
  MotionFormat format = MotionFormat::bvh;
  std::vector<Joint> joints;
  int channel_count = 0;
  double millimetres_per_unit = default_millimetres_per_unit;
  UpAxis up = UpAxis::y;
  bool unit_assumed = false;  ///< neither the file nor the user says the unit
  bool up_assumed = false;    ///< the user does not say which axis points up; no file does
  /// The text that describes the skeleton, byte for byte: a BVH file up to and without its line
  /// `MOTION`, or the whole ASF file. Parsing it gives this skeleton again.
  std::string source_text;
  std::string asf_name;  ///< ASF: file name without folder and extension, else empty
  bool radians = false;  ///< ASF: `angle rad`, which holds for AMC files that say nothing else
};

/// True if both have the same names, hierarchy, channels and rotation orders, so that their takes
/// can share one coefficient space; offsets, lengths and axes may differ.
bool same_structure(const Skeleton& a, const Skeleton& b);

/// Canonical bytes of all that `same_structure` compares, for digests.
std::string structure_bytes(const Skeleton& skeleton);

}  // namespace reprise
