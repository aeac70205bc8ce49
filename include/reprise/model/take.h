// One recorded motion.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "reprise/model/skeleton.h"

namespace reprise {

/// frames x channels, row-major; lengths in the file's unit, rotations in degrees.
using ChannelMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Whether a take may have this rate (frames a second).
constexpr bool is_frame_rate(double rate) { return rate > 1e-6 && rate < 1e6; }

/// What a motion file says besides its numbers, so that what comes out looks like what came in.
struct TakeLayout {
  /// BVH: the frame time as written, such as "0.0333333"; of a rate that was given, its own
  std::string frame_time_text;
  std::string amc_header;  ///< AMC: the lines before the first frame, byte for byte
  /// AMC: indices of the joints that have a line in each frame, in the file's order. A joint with
  /// channels that is not among them keeps zeros.
  std::vector<int> amc_joints;
  long first_frame_number = 1;  ///< AMC: the number of its first frame
  bool radians = false;         ///< AMC: rotations are written in radians
};

/// What was read otherwise than a file says, as a sentence, and where it says so.
struct SourceNote {
  std::size_t line = 0;
  std::string what;
};

struct Take {
  std::string name;  ///< path under the ingested folder without extension, with '/'
  std::shared_ptr<const Skeleton> skeleton;
  ChannelMatrix channels;           ///< frames x skeleton->channel_count
  double frame_rate = 0;            ///< frames a second; greater than 0
  bool frame_rate_assumed = false;  ///< the file does not say it (AMC), or says 0 (BVH)
  TakeLayout layout;
  std::vector<SourceNote> notes;  ///< of the file that it was read from; not stored

  long frames() const { return channels.rows(); }
  double seconds() const { return static_cast<double>(frames()) / frame_rate; }
};

}  // namespace reprise
