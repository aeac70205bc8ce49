// A body as a skeleton of one of the two formats.
#pragma once

#include <memory>
#include <string>

#include "reprise/model/skeleton.h"
#include "synth/body.h"

namespace reprise::synth {

/// Millimetres of one unit of length in what is written: centimetres in BVH, CMU's unit (:length
/// 0.45) in ASF.
constexpr double bvh_unit = 10.0;
constexpr double asf_unit = 25.4 / 0.45;

std::string bvh_hierarchy_text(const Proportions& body);
std::string asf_text(const Proportions& body, const std::string& name);

/// The skeleton that those texts describe; `name` is that of the subject.
std::shared_ptr<const Skeleton> make_skeleton(MotionFormat format, const Proportions& body,
                                              const std::string& name);

}  // namespace reprise::synth
