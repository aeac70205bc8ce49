// Poses as the numbers of a motion file.
#pragma once

#include "reprise/model/take.h"
#include "synth/poses.h"

namespace reprise::synth {

/// Decimals of every number of a synthetic file; channels are rounded to them, so that files read
/// back equal.
constexpr int file_decimals = 4;

/// frames x skeleton.channel_count. Euler angles run on past 180 degrees instead of jumping.
ChannelMatrix make_channels(const PoseMatrix& poses, const Skeleton& skeleton);

}  // namespace reprise::synth
