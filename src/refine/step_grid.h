// How finely each knot of each channel is rounded: a step a channel, made finer or coarser for the
// channels of a joint during a stretch of time.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "quant/range_coder.h"
#include "quant/take_codec.h"
#include "refine/coding_order.h"

namespace reprise {

/// Steps are powers of 2^(1/8) of a degree or of the file's unit of length.
struct StepConstants {
  static constexpr int one = 320;  ///< index of the step 1
  static constexpr int most = 511;
  static constexpr int per_octave = 8;
  static constexpr int per_base = 2;    ///< a channel's step is a quarter of an octave
  static constexpr int per_offset = 4;  ///< an offset is half an octave
  static constexpr int least_offset = -8, most_offset = 40;
};

/// The step of an index, cut to 0 .. most.
double step_of(int index);
/// The multiple of per_base whose step is nearest to a positive number.
int step_index(double step);

class StepGrid {
 public:
  StepGrid() = default;
  StepGrid(const Skeleton& skeleton, const CodingOrder& order, long frames, int levels);

  /// Stretches of time are 2^levels frames long, around the frames at multiples of that.
  Eigen::Index block(Eigen::Index frame) const { return (frame + half_) >> levels_; }
  Eigen::Index first_frame(Eigen::Index block) const { return (block << levels_) - half_; }
  int group(std::size_t place) const { return groups_[place]; }
  /// The group of a joint's channels, or of the nearest joint above it that has some; -1 for none.
  int group_of_joint(std::size_t joint) const { return joints_[joint]; }
  /// The group that a group hangs on, or -1.
  int parent_of_group(int group) const { return parents_[static_cast<std::size_t>(group)]; }
  int offset(std::size_t place, Eigen::Index frame) const {
    return offsets(block(frame), groups_[place]);
  }
  double step(std::size_t place, Eigen::Index frame) const {
    return step_of(base[place] - StepConstants::per_offset * offset(place, frame));
  }

  void encode(RangeEncoder& encoder) const;
  /// False: the bytes are not a grid's.
  bool decode(RangeDecoder& decoder);

  /// Of each channel in coding order, a multiple of per_base; -1: its numbers are stored as they
  /// are.
  std::vector<int> base;
  /// blocks x joints with channels that move: half octaves finer.
  Eigen::Matrix<std::int8_t, Eigen::Dynamic, Eigen::Dynamic> offsets;

 private:
  int levels_ = 0;
  Eigen::Index half_ = 0;
  std::vector<int> groups_;   ///< of each channel
  std::vector<int> joints_;   ///< of each joint: its group, or the nearest one above, or -1
  std::vector<bool> turns_;   ///< of each channel: it is a rotation
  std::vector<int> parents_;  ///< of each group: the group it hangs on, or -1
};

}  // namespace reprise
