// Angles are degrees in files and channels, and radians in every calculation.
#pragma once

#include <numbers>

namespace reprise {

constexpr double radians_per_degree = std::numbers::pi / 180.0;
constexpr double degrees_per_radian = 180.0 / std::numbers::pi;

}  // namespace reprise
