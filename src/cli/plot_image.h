// A self-distance plot as a picture.
#pragma once

#include <string>

#include "reprise/self_distance.h"

namespace reprise::cli {

/// A PNG file. Time runs to the right and down, a tick every 5 seconds; the darker a pixel, the
/// more alike two postures are; white is beyond what counts as similar twice over. Paths are red,
/// above the diagonal. Under the plot a strip of behaviours, a colour a group, and a strip of
/// clips: primary blue, repeated green, unique grey.
std::string png_of(const SelfDistance& plot);

}  // namespace reprise::cli
