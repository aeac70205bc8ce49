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
/// rest of the plot is left out. A byte a pixel stays; distances and costs are those of a few rows.
class AlignmentPlot {
 public:
  AlignmentPlot(const PostureView& clip, const PostureView& take, float most_cost)
      : clip_(clip.projected),
        take_(take.projected),
        take_squares_(take_.rowwise().squaredNorm()),
        rows_(clip_.rows()),
        columns_(take_.rows()),
        cost_(PostureMatrix::Constant(cost_rows, columns_, never)) {
    step_.reserve(static_cast<std::size_t>(rows_ * columns_));  // touched row by row
    for (long r = 0, hopeless = 0; r < rows_; ++r) {
      if (r % block_rows == 0) measure_rows(r);
      fill_row(r);
      hopeless = cost_.row(r % cost_rows).minCoeff() > most_cost ? hopeless + 1 : 0;
      if (hopeless == RepeatConstants::steepest && r + 1 < rows_) {
        cost_.row((rows_ - 1) % cost_rows).setConstant(never);
        return;
      }
    }
  }

  /// Mean distance of the best alignment that ends at this column.
  float cost_at(long column) const {
    return cost_((rows_ - 1) % cost_rows, column) / static_cast<float>(rows_);
  }

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
  /// A row is reached from at most so many before it.
  static constexpr long cost_rows = RepeatConstants::steepest + 1;
  static constexpr long block_rows = 64;

  /// Distances of the block of rows that begins here.
  void measure_rows(long first) {
    const auto block = clip_.middleRows(first, std::min(block_rows, rows_ - first));
    distance_ = -2 * block * take_.transpose();
    distance_.colwise() += block.rowwise().squaredNorm();
    distance_.rowwise() += take_squares_.transpose();
    distance_ = distance_.cwiseMax(0).cwiseSqrt();
  }

  void fill_row(long r) {
    const auto distance = distance_.row(r % block_rows);
    auto cost = cost_.row(r % cost_rows);
    step_.resize(static_cast<std::size_t>((r + 1) * columns_), -1);
    if (r == 0) {
      cost = distance;
      return;
    }
    cost.setConstant(never);
    for (std::size_t s = 0; s < path_steps.size(); ++s) {
      const PathStep step = path_steps[s];
      if (step.x > r) continue;
      const auto from = cost_.row((r - step.x) % cost_rows);
      const auto times = static_cast<float>(step.x);
      for (long c = step.y; c < columns_; ++c) {
        const float reached = from[c - step.y] + times * distance[c];
        if (reached < cost[c]) {
          cost[c] = reached;
          step_[static_cast<std::size_t>(r * columns_ + c)] = static_cast<std::int8_t>(s);
        }
      }
    }
  }

  Eigen::Ref<const PostureMatrix> clip_, take_;
  Eigen::VectorXf take_squares_;
  long rows_, columns_;
  PostureMatrix cost_;      ///< of the last rows, each in the place of its number modulo cost_rows
  PostureMatrix distance_;  ///< of the block of rows that is filled
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
