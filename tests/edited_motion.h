// Motions as other exporters would have written them: with another axis up, in another unit, under
// other names.
#pragma once

#include <fmt/format.h>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "reprise/formats/motion_file.h"
#include "reprise/model/kinematics.h"
#include "reprise/synth/library.h"

namespace reprise::edited {

inline constexpr std::array every_up = {UpAxis::x,       UpAxis::y,       UpAxis::z,
                                        UpAxis::minus_x, UpAxis::minus_y, UpAxis::minus_z};

/// The BVH hierarchy of a skeleton, numbers in full.
inline std::string bvh_hierarchy(const Skeleton& skeleton) {
  constexpr std::array<const char*, 6> words = {"Xposition", "Yposition", "Zposition",
                                                "Xrotation", "Yrotation", "Zrotation"};
  std::string text = "HIERARCHY\n";
  const std::function<void(int)> append = [&](int j) {
    const Joint& joint = skeleton.joints[static_cast<std::size_t>(j)];
    text += joint.end_site ? "End Site" : (joint.parent < 0 ? "ROOT " : "JOINT ") + joint.name;
    text += fmt::format("\n{{\nOFFSET {:.9f} {:.9f} {:.9f}\n", joint.offset[0], joint.offset[1],
                        joint.offset[2]);
    if (!joint.end_site) {
      text += fmt::format("CHANNELS {}", joint.channels.size());
      for (const Channel channel : joint.channels) {
        text += std::string(" ") + words[static_cast<std::size_t>(channel)];
      }
      text += "\n";
    }
    for (int child = j + 1; child < static_cast<int>(skeleton.joints.size()); ++child) {
      if (skeleton.joints[static_cast<std::size_t>(child)].parent == j) append(child);
    }
    text += "}\n";
  };
  append(0);
  return text;
}

/// The take with a skeleton that `edit` has changed, and a text that says so (BVH).
template <class Edit>
Take with_skeleton(const Take& take, const Edit& edit) {
  auto skeleton = std::make_shared<Skeleton>(*take.skeleton);
  edit(*skeleton);
  if (skeleton->format == MotionFormat::bvh) skeleton->source_text = bvh_hierarchy(*skeleton);
  Take edited = take;
  edited.skeleton = skeleton;
  return edited;
}

/// Of a take that has Y up: rest pose and motion turned together, so that `up` is up. The skeleton
/// does not say so.
inline Take turned(const Take& take, UpAxis up) {
  const Eigen::Matrix3d turn = turn_to_y(up).transpose();
  // A rotation about an axis that is turned into the opposite of one goes the other way.
  const auto sign = [&](Channel channel) { return turn.col(axis_of(channel)).sum(); };
  const auto other = [&](Channel channel) {
    Eigen::Index axis = 0;
    turn.col(axis_of(channel)).cwiseAbs().maxCoeff(&axis);
    return static_cast<Channel>(static_cast<int>(axis) + (is_position(channel) ? 0 : 3));
  };
  const bool bvh = take.skeleton->format == MotionFormat::bvh;
  Take result = with_skeleton(take, [&](Skeleton& skeleton) {
    for (Joint& joint : skeleton.joints) {
      joint.offset = turn * joint.offset;
      if (!bvh) joint.axis = turn * joint.axis;
      for (std::size_t c = 0; bvh && c < joint.channels.size(); ++c) {
        joint.channels[c] = other(joint.channels[c]);
      }
      for (std::size_t k = 0; bvh && k < joint.rotation_order.size(); ++k) {
        joint.rotation_order[k] =
            axis_of(joint.channels[static_cast<std::size_t>(joint.rotation_slots[k])]);
      }
    }
  });
  for (const Joint& joint : take.skeleton->joints) {
    for (std::size_t c = 0; bvh && c < joint.channels.size(); ++c) {
      result.channels.col(joint.first_channel + static_cast<Eigen::Index>(c)) *=
          sign(joint.channels[c]);
    }
  }
  return result;
}

/// The same motion with lengths in a unit of `unit_mm` instead of centimetres (BVH); the skeleton
/// does not say so.
inline Take in_unit(const Take& take, double unit_mm) {
  const double factor = default_millimetres_per_unit / unit_mm;
  Take result = with_skeleton(take, [&](Skeleton& skeleton) {
    for (Joint& joint : skeleton.joints) joint.offset *= factor;
  });
  for (const Joint& joint : result.skeleton->joints) {
    for (std::size_t c = 0; c < joint.channels.size(); ++c) {
      if (is_position(joint.channels[c])) {
        result.channels.col(joint.first_channel + static_cast<Eigen::Index>(c)) *= factor;
      }
    }
  }
  return result;
}

/// With the joints' names that `rename` gives.
template <class Rename>
Take renamed(const Take& take, const Rename& rename) {
  return with_skeleton(take, [&](Skeleton& skeleton) {
    for (Joint& joint : skeleton.joints) {
      if (!joint.end_site) joint.name = rename(joint.name);
    }
  });
}

/// Synthetic takes, in centimetres with Y up.
inline std::vector<Take> synthetic_takes(int takes, double seconds,
                                         MotionFormat format = MotionFormat::bvh) {
  SynthOptions options;
  options.takes = takes;
  options.subjects = 1;
  options.seconds = seconds;
  options.format = format;
  return make_synthetic_library(options).takes;
}

}  // namespace reprise::edited
