// Where decoded angles must be told which of several ways to write a rotation the source uses.
#include <algorithm>
#include <array>
#include <cmath>

#include "ingest/trajectories.h"

namespace reprise {
namespace {

/// A switch is worth its bytes only where the angles are this far (degrees) from the source's
/// branch ...
constexpr double wrong_branch_degrees = 120.0;
/// ... and stay so for this long (seconds), so that a passage through gimbal lock does not flicker.
constexpr double least_wrong_seconds = 0.1;

using Angles = std::array<double, 3>;

double furthest(const Angles& a, const Angles& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

Angles moved_by_turns(Angles angles, const Angles& near) {
  for (int k = 0; k < 3; ++k) angles[k] += 360.0 * std::round((near[k] - angles[k]) / 360.0);
  return angles;
}

/// The way to write the same rotation that is nearest to `near`; `flips` where a second way exists.
Angles nearest_writing(const Angles& angles, bool flips, const Angles& near) {
  const Angles same = moved_by_turns(angles, near);
  if (!flips) return same;
  const Angles flipped =
      moved_by_turns({angles[0] + 180.0, 180.0 - angles[1], angles[2] + 180.0}, near);
  return furthest(flipped, near) < furthest(same, near) ? flipped : same;
}

/// The angles of one joint in every frame, outermost first; missing ones are 0.
std::vector<Angles> angles_of(const ChannelMatrix& channels,
                              const std::vector<RotationChannel>& rotations) {
  std::vector<Angles> result(channels.rows(), Angles{});
  for (long f = 0; f < channels.rows(); ++f) {
    for (std::size_t k = 0; k < rotations.size(); ++k) {
      result[f][k] = channels(f, rotations[k].channel);
    }
  }
  return result;
}

void find_switches(int driven, const std::vector<RotationChannel>& rotations, const Take& source,
                   const ChannelMatrix& decoded, std::vector<BranchSwitch>& found) {
  if (rotations.size() > 3) return;
  const bool flips = turns_about_three_axes(rotations);
  std::vector<Angles> wanted = angles_of(source.channels, rotations);
  for (std::size_t f = 1; f < wanted.size(); ++f) {
    wanted[f] = nearest_writing(wanted[f], flips, wanted[f - 1]);
  }
  const std::vector<Angles> got = angles_of(decoded, rotations);
  const long patience = std::lround(least_wrong_seconds * source.frame_rate);
  // What continuity makes of the decoded angles after the switches found so far.
  Angles now = got.empty() ? Angles{} : got[0];
  long wrong_for = 0;
  for (std::size_t f = 0; f < got.size(); ++f) {
    now = nearest_writing(got[f], flips, now);
    const Angles best = nearest_writing(got[f], flips, wanted[f]);
    const bool wrong = furthest(now, wanted[f]) > wrong_branch_degrees &&
                       furthest(best, wanted[f]) < wrong_branch_degrees / 2;
    wrong_for = wrong ? wrong_for + 1 : 0;
    if (!wrong || (f > 0 && wrong_for < patience)) continue;
    BranchSwitch branch{static_cast<std::int32_t>(f), driven, {}};
    for (int k = 0; k < 3; ++k) {
      branch.quarter_turns[k] = static_cast<std::int32_t>(std::lround(best[k] / 90.0));
    }
    found.push_back(branch);
    now = best;
    wrong_for = 0;
  }
}

}  // namespace

std::vector<BranchSwitch> find_branch_switches(const CoefficientSpace& space, const Take& source,
                                               const ChannelMatrix& decoded) {
  std::vector<BranchSwitch> found;
  const MarkerLayout& layout = space.layout;
  for (std::size_t d = 0; d < layout.driven.size(); ++d) {
    if (layout.driven[d].joint == layout.choices.root_joint) continue;
    find_switches(static_cast<int>(d), layout.driven[d].rotations, source, decoded, found);
  }
  if (layout.root_aligned) {
    auto rotations = rotation_channels(layout.reference.joints[layout.choices.root_joint]);
    for (RotationChannel& rotation : rotations) rotation.active = true;
    find_switches(-1, rotations, source, decoded, found);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const BranchSwitch& a, const BranchSwitch& b) { return a.frame < b.frame; });
  return found;
}

}  // namespace reprise
