// The hierarchy of a BVH: what stands between HIERARCHY and MOTION.
#pragma once

#include <string_view>

#include "formats/text_lines.h"
#include "reprise/model/skeleton.h"

namespace reprise {

/// Reads the lines of `text` up to and with `MOTION`, or to its end where `motion_follows` is
/// false. What was read, `MOTION` left out, is the skeleton's source text. Throws Error
/// (rejected_input).
Skeleton read_bvh_hierarchy(TextLines& lines, std::string_view text, double millimetres_per_unit,
                            bool motion_follows);

}  // namespace reprise
