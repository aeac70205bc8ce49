#include "model/written_channels.h"

namespace reprise {

std::vector<bool> written_joints(const Skeleton& skeleton, const TakeLayout& layout) {
  const bool all = skeleton.format != MotionFormat::asf_amc || layout.amc_joints.empty();
  std::vector<bool> written(skeleton.joints.size(), all);
  if (all) return written;
  for (const int joint : layout.amc_joints) written[static_cast<std::size_t>(joint)] = true;
  return written;
}

void clear_unwritten_channels(const Skeleton& skeleton, const TakeLayout& layout,
                              ChannelMatrix& channels) {
  const std::vector<bool> written = written_joints(skeleton, layout);
  for (std::size_t j = 0; j < written.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    const auto count = static_cast<Eigen::Index>(joint.channels.size());
    if (!written[j] && count > 0) channels.middleCols(joint.first_channel, count).setZero();
  }
}

}  // namespace reprise
