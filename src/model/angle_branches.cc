#include "model/angle_branches.h"

#include <algorithm>
#include <cmath>

namespace reprise {
namespace {

using Eigen::Index;

/// A step of an angle up to this (degrees) may be motion; a larger one is looked at.
constexpr double suspicious_degrees = 90;
/// Another way to write the angles has to be nearer than this part of the step.
constexpr double nearer = 0.5;
/// A branch in more than one of so many frames is noise, not a way of writing.
constexpr long least_frames_apart = 4;

/// Angles of one joint in a frame, outermost first, in degrees.
using Angles = std::vector<double>;

double furthest(const Angles& a, const Angles& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

Angles flip(Angles angles) { return {angles[0] + 180, 180 - angles[1], angles[2] + 180}; }

std::vector<Index> columns_of(const Joint& joint) {
  std::vector<Index> columns;
  for (const int slot : joint.rotation_slots) columns.push_back(joint.first_channel + slot);
  return columns;
}

Angles angles_of(const ChannelMatrix& channels, Index frame, const std::vector<Index>& columns) {
  Angles angles;
  for (const Index column : columns) angles.push_back(channels(frame, column));
  return angles;
}

/// A way to write angles smoothly: those of the source, flipped or not, plus whole turns.
struct Writing {
  bool flipped = false;
  std::vector<std::int32_t> turns;

  Angles smooth(const Angles& source) const {
    Angles angles = flipped ? flip(source) : source;
    for (std::size_t k = 0; k < angles.size(); ++k) angles[k] += 360.0 * turns[k];
    return angles;
  }
  Angles source(Angles smooth) const {
    for (std::size_t k = 0; k < smooth.size(); ++k) smooth[k] -= 360.0 * turns[k];
    // Flipping twice adds a whole turn to the first and the last angle.
    return flipped ? Angles{smooth[0] - 180, 180 - smooth[1], smooth[2] - 180} : smooth;
  }
  bool operator==(const Writing&) const = default;
};

/// The whole turns that bring angles nearest to `near`.
Writing nearest(const Angles& source, bool flipped, const Angles& near) {
  Writing writing{flipped, {}};
  const Angles angles = flipped ? flip(source) : source;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double turns = std::round((near[k] - angles[k]) / 360.0);
    writing.turns.push_back(std::abs(turns) <= most_turns ? static_cast<std::int32_t>(turns) : 0);
  }
  return writing;
}

/// The branches of one joint, whose columns of `channels` become smooth.
std::vector<AngleBranch> smooth_joint(int index, const Joint& joint,
                                      const ChannelConstants& constants, ChannelMatrix& channels) {
  const std::vector<Index> columns = columns_of(joint);
  // The second set would move an angle that is constant.
  const bool flips = has_second_angles(joint) && std::ranges::none_of(columns, [&](Index column) {
                       return constants[static_cast<std::size_t>(column)].has_value();
                     });
  std::vector<AngleBranch> branches;
  Writing now{false, std::vector<std::int32_t>(columns.size(), 0)};
  Angles before = angles_of(channels, 0, columns);
  const Eigen::MatrixXd untouched = channels(Eigen::all, columns);
  for (Index f = 1; f < channels.rows(); ++f) {
    const Angles source = angles_of(channels, f, columns);
    Angles angles = now.smooth(source);
    const double step = furthest(angles, before);
    if (step > suspicious_degrees) {
      Writing best = nearest(source, false, before);
      if (flips) {
        Writing other = nearest(source, true, before);
        if (furthest(other.smooth(source), before) < furthest(best.smooth(source), before)) {
          best = std::move(other);
        }
      }
      if (best != now && furthest(best.smooth(source), before) < nearer * step) {
        now = std::move(best);
        angles = now.smooth(source);
        branches.push_back({static_cast<std::int32_t>(f), index, now.flipped, now.turns});
      }
    }
    for (std::size_t k = 0; k < columns.size(); ++k) channels(f, columns[k]) = angles[k];
    before = std::move(angles);
  }
  if (static_cast<Index>(branches.size()) * least_frames_apart > channels.rows()) {
    channels(Eigen::all, columns) = untouched;
    branches.clear();
  }
  return branches;
}

}  // namespace

bool has_second_angles(const Joint& joint) {
  const auto& axes = joint.rotation_order;
  return axes.size() == 3 && axes[0] != axes[1] && axes[1] != axes[2] && axes[0] != axes[2];
}

std::vector<AngleBranch> smooth_angles(const Skeleton& skeleton, const ChannelConstants& constants,
                                       ChannelMatrix& channels) {
  std::vector<AngleBranch> branches;
  if (channels.rows() == 0) return branches;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (skeleton.joints[j].rotation_slots.empty()) continue;
    std::vector<AngleBranch> own =
        smooth_joint(static_cast<int>(j), skeleton.joints[j], constants, channels);
    branches.insert(branches.end(), own.begin(), own.end());
  }
  std::ranges::stable_sort(branches, {}, &AngleBranch::frame);
  return branches;
}

void restore_angles(const Skeleton& skeleton, const std::vector<AngleBranch>& branches,
                    ChannelMatrix& channels) {
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const AngleBranch& branch = branches[b];
    const auto next =
        std::find_if(branches.begin() + static_cast<std::ptrdiff_t>(b) + 1, branches.end(),
                     [&](const AngleBranch& other) { return other.joint == branch.joint; });
    const Index end = next == branches.end() ? channels.rows() : Index{next->frame};
    const std::vector<Index> columns =
        columns_of(skeleton.joints[static_cast<std::size_t>(branch.joint)]);
    const Writing writing{branch.flipped, branch.turns};
    for (Index f = branch.frame; f < end; ++f) {
      const Angles angles = writing.source(angles_of(channels, f, columns));
      for (std::size_t k = 0; k < columns.size(); ++k) channels(f, columns[k]) = angles[k];
    }
  }
}

}  // namespace reprise
