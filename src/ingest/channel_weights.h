// How far a skeleton moves for one unit of what is coded: an error of a channel, of heading or of a
// step over the ground counts by it.
#pragma once

#include <vector>

#include "ingest/marker_layout.h"

namespace reprise {

/// Of each joint: it is `root`, or hangs below it.
std::vector<bool> joints_under(const Skeleton& skeleton, int root);

/// Lists the channels that no marker of the layout carries, with the weight of each, and fills in
/// the weights of heading and of the root's steps.
void weigh_channels(MarkerLayout& layout);

}  // namespace reprise
