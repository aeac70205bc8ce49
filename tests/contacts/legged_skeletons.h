// Bodies with feet, for tests.
#pragma once

#include <memory>

#include "ingest/skeletons.h"
#include "reprise/model/kinematics.h"

namespace reprise::testing_contacts {

namespace skeletons = testing_skeletons;

/// Two legs of hip, knee, ankle and toes, in centimetres; 4 is the end of the left toes.
inline std::shared_ptr<const Skeleton> legs_of_bvh(const std::string& ankle = "ankle",
                                                   const std::string& toes = "toes") {
  const auto leg = [&](const std::string& side, const std::string& offset) {
    const std::string foot = skeletons::joint(
        side + ankle, "0 -40 0", skeletons::zxy,
        skeletons::joint(side + toes, "0 -7 12", "1 Xrotation", skeletons::end_site("0 0 6")));
    return skeletons::joint(
        side + "hip", offset, skeletons::zxy,
        skeletons::joint(side + "knee", "0 -42 1", "3 Xrotation Yrotation Zrotation", foot));
  };
  const std::string head =
      skeletons::joint("spine", "0 30 0", skeletons::zxy, skeletons::end_site("0 30 0"));
  return skeletons::bvh(
      skeletons::root(skeletons::six, leg("left_", "9 -4 0") + leg("right_", "-9 -4 0") + head));
}

/// A bent knee sways over a foot that slides: what a coarse coding makes of a standing foot.
inline ChannelMatrix swaying(const Skeleton& skeleton, long frames) {
  ChannelMatrix channels = ChannelMatrix::Zero(frames, skeleton.channel_count);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    for (std::size_t k = 0; k < joint.channels.size(); ++k) {
      const bool turns = is_rotation(joint.channels[k]);
      const bool knee = joint.name.find("knee") != std::string::npos || joint.name == "tibia";
      const double centre = turns && knee && axis_of(joint.channels[k]) == 0 ? 30 : 3;
      const double swing = turns ? 2 : 20 / skeleton.millimetres_per_unit;
      for (long f = 0; f < frames; ++f) {
        const double time = static_cast<double>(f) / 60;
        channels(f, joint.first_channel + static_cast<Eigen::Index>(k)) =
            centre + swing * std::sin(2 * time + static_cast<double>(j + k));
      }
    }
  }
  return channels;
}

}  // namespace reprise::testing_contacts
