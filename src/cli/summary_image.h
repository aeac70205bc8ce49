// A take summed up in a row of stick figures.
#pragma once

#include <string>
#include <vector>

#include "reprise/query/key_poses.h"

namespace reprise::cli {

/// A PNG file: one figure a key pose, all of one scale and on one ground, seen from the right
/// front; nearer bones are darker. Where hips are not known, figures are not turned. Under each
/// figure is a bar in a colour of its own; the strip at the bottom is the take from its start to
/// its end, with the run of each key pose in its colour and a black mark at its time. The take has
/// at least one frame.
std::string png_of(const Take& take, const std::vector<KeyPose>& poses, const JointMap& map);

}  // namespace reprise::cli
