// What chosen clips leave of takes.
#pragma once

#include <span>
#include <vector>

#include "rma/chosen_clip.h"

namespace reprise {

/// What is left of each take, which has so many `samples`, becomes unique; what is shorter than
/// `least` samples goes to the repeated clip before it, or to the one after it: never to a primary,
/// which others refer to. The clips come in the order of takes and time, and cover all of them.
std::vector<ChosenClip> cover_takes(std::vector<ChosenClip> clips, std::span<const long> samples,
                                    long least);

}  // namespace reprise
