// Which channels of a take its file has numbers for: an AMC may leave bones of its ASF out.
#pragma once

#include <vector>

#include "reprise/model/take.h"

namespace reprise {

/// Of each joint: its channels are written. Those of others are zero, whatever a coder would like.
std::vector<bool> written_joints(const Skeleton& skeleton, const TakeLayout& layout);

/// Sets the channels of the other joints to zero, which is what comes back from a file.
void clear_unwritten_channels(const Skeleton& skeleton, const TakeLayout& layout,
                              ChannelMatrix& channels);

}  // namespace reprise
