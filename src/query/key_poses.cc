#include "reprise/query/key_poses.h"

#include <algorithm>

#include "query/likeness.h"
#include "query/optimal_partition.h"

namespace reprise {
namespace {

/// Postures that a take is looked at in, at most.
constexpr long most_postures = 1500;

}  // namespace

std::vector<KeyPose> key_poses(const Take& take, const JointMap& map, int count) {
  const PostureTrack track = posture_track(take, map);
  const double length = static_cast<double>(track.frames() - 1) / PostureConstants::rate;
  const long samples = std::min(track.frames(), most_postures);
  const Eigen::MatrixXd rows = postures(track, {0, length}, static_cast<int>(samples), 0.0f)
                                   .leftCols<plan_bones * 3>()
                                   .cast<double>();
  const double step = samples > 1 ? length / static_cast<double>(samples - 1) : 0.0;
  const std::vector<long> starts = optimal_partition(rows, count);
  std::vector<KeyPose> poses;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const long begin = starts[i];
    const long end = i + 1 < starts.size() ? starts[i + 1] : samples;
    const auto run = rows.middleRows(begin, end - begin);
    long nearest = 0;
    (run.rowwise() - run.colwise().mean()).rowwise().squaredNorm().minCoeff(&nearest);
    poses.push_back({static_cast<double>(begin) * step,
                     end == samples ? take.seconds() : static_cast<double>(end) * step,
                     static_cast<double>(begin + nearest) * step});
  }
  return poses;
}

}  // namespace reprise
