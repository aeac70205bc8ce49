// Knots of a channel as whole numbers of steps.
#pragma once

#include <Eigen/Core>

#include "refine/coded_channels.h"

namespace reprise {

/// Rounds `values`, one a frame: a channel's knots as NestedKnots leaves them, into the numbers of
/// the channel at `place` of the coding order. Channels before it are rounded already. False, and
/// nothing of use, where a number is too large for its step.
bool round_knots(const Eigen::VectorXd& values, std::size_t place, CodedChannels& coded);

}  // namespace reprise
