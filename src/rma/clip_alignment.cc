#include "rma/clip_alignment.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "rma/path_steps.h"

namespace reprise {
namespace {

constexpr float never = std::numeric_limits<float>::infinity();

/// Least-cost alignments of all of a clip (rows) with some part of a take (columns), free at both
/// ends of the take. Steps have x along the clip and y along the take. A row costs once, whatever
/// the speed. Costs never fall along an alignment: once none is within `most_cost` any more, the
/// rest of the plot is left out.
class AlignmentPlot {
 public:
  AlignmentPlot(const PostureView& clip, const PostureView& take, float most_cost)
      : rows_(clip.projected.rows()), columns_(take.projected.rows()) {
    distance_ = -2 * clip.projected * take.projected.transpose();
    distance_.colwise() += clip.projected.rowwise().squaredNorm();
    distance_.rowwise() += take.projected.rowwise().squaredNorm().transpose();
    distance_ = distance_.cwiseMax(0).cwiseSqrt();
    cost_ = PostureMatrix::Constant(rows_, columns_, never);
    step_.resize(static_cast<std::size_t>(rows_ * columns_), -1);
    cost_.row(0) = distance_.row(0);
    for (long r = 1, hopeless = 0; r < rows_; ++r) {
      hopeless = cost_.row(r - 1).minCoeff() > most_cost ? hopeless + 1 : 0;
      if (hopeless == RepeatConstants::steepest) return;
      fill_row(r);
    }
  }

  /// Mean distance of the best alignment that ends at this column.
  float cost_at(long column) const { return cost_(rows_ - 1, column) / static_cast<float>(rows_); }

  std::vector<long> map_to(long column) const {
    std::vector<long> map(static_cast<std::size_t>(rows_), column);
    long row = rows_ - 1;
    while (row > 0) {
      const PathStep& step = path_steps[static_cast<std::size_t>(
          step_[static_cast<std::size_t>(row * columns_ + column)])];
      for (int s = 0; s < step.x; ++s) map[static_cast<std::size_t>(row - s)] = column;
      row -= step.x;
      column -= step.y;
    }
    map[0] = column;
    return map;
  }

 private:
  void fill_row(long r) {
    for (std::size_t s = 0; s < path_steps.size(); ++s) {
      const PathStep step = path_steps[s];
      if (step.x > r) continue;
      const auto times = static_cast<float>(step.x);
      for (long c = step.y; c < columns_; ++c) {
        const float cost = cost_(r - step.x, c - step.y) + times * distance_(r, c);
        if (cost < cost_(r, c)) {
          cost_(r, c) = cost;
          step_[static_cast<std::size_t>(r * columns_ + c)] = static_cast<std::int8_t>(s);
        }
      }
    }
  }

  long rows_, columns_;
  PostureMatrix distance_, cost_;
  std::vector<std::int8_t> step_;
};

float mean_along(const PostureView& clip, const PostureView& take, const std::vector<long>& map) {
  float sum = 0;
  for (std::size_t s = 0; s < map.size(); ++s) {
    sum += mean_joint_distance(clip.postures.row(static_cast<long>(s)).data(),
                               take.postures.row(map[s]).data(), clip.postures.cols());
  }
  return sum / static_cast<float>(map.size());
}

}  // namespace

std::vector<AlignedClip> align_clip(const PostureView& clip, const PostureView& take,
                                    float most_mm) {
  // The root mean square distance of joints is above their mean, seldom by more than this.
  constexpr float mean_to_rms = 1.6F;
  std::vector<AlignedClip> kept;
  if (clip.projected.rows() < 2 || take.projected.rows() < 2) return kept;
  const float most_cost = mean_to_rms * most_mm;
  const AlignmentPlot plot(clip, take, most_cost * static_cast<float>(clip.projected.rows()));
  std::vector<std::pair<float, long>> ends;
  for (long c = 0; c < take.projected.rows(); ++c) {
    const float cost = plot.cost_at(c);
    const bool least = (c == 0 || cost <= plot.cost_at(c - 1)) &&
                       (c + 1 == take.projected.rows() || cost < plot.cost_at(c + 1));
    if (least && cost <= most_cost) ends.emplace_back(cost, c);
  }
  std::sort(ends.begin(), ends.end());
  for (const auto& [cost, column] : ends) {
    AlignedClip found;
    found.map = plot.map_to(column);
    found.begin = found.map.front();
    found.end = found.map.back() + 1;
    const bool taken = std::ranges::any_of(
        kept, [&](const AlignedClip& k) { return found.begin < k.end && k.begin < found.end; });
    if (taken) continue;
    found.mean_mm = mean_along(clip, take, found.map);
    if (found.mean_mm <= most_mm) kept.push_back(std::move(found));
  }
  return kept;
}

}  // namespace reprise
