// How joints are called in motion files.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reprise/query/body_joints.h"

namespace reprise {

/// The words for a body joint without its side, the surest first; lower case, letters and digits.
std::span<const std::string_view> words_for(BodyJoint joint, MotionFormat format);

/// Lower case, letters and digits only, without a name space and without the prefixes of
/// exporters: "mixamorig:LeftUpLeg" gives "leftupleg", "CC_Base_L_Thigh" gives "lthigh".
std::string plain_name(std::string_view name);

/// The same of each joint of a skeleton, also without words that most of its names begin or end
/// with: "l_upleg_JNT" among names in "JNT" gives "lupleg". An end site has none.
std::vector<std::string> plain_names(const Skeleton& skeleton);

/// True if the plain name is the word with the side that the body joint has.
bool is_called(std::string_view plain_name, BodyJoint joint, std::string_view word);

}  // namespace reprise
