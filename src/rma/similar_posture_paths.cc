#include "rma/similar_posture_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

namespace reprise {
namespace {

struct Step {
  int x;
  int y;
};
/// The diagonal first: it wins ties.
constexpr std::array<Step, 5> steps{{{1, 1}, {1, 2}, {2, 1}, {1, 3}, {3, 1}}};
static_assert(RepeatConstants::steepest == 3);

constexpr float never = -std::numeric_limits<float>::infinity();

/// One row of the explored part of a plot.
struct Row {
  long first = 0;
  std::vector<float> score;
  std::vector<std::int8_t> step;  ///< index into `steps`, by which the pixel was reached

  long end() const { return first + static_cast<long>(score.size()); }
  float at(long column) const {
    return column < first || column >= end() ? never
                                             : score[static_cast<std::size_t>(column - first)];
  }
};

/// Explores from one pixel towards one corner of the plot.
class Explorer {
 public:
  Explorer(const PlotSide& x, const PlotSide& y, PlotPixel start, int direction, long least_lag,
           const RepeatConstants& constants)
      : x_(x),
        y_(y),
        start_(start),
        direction_(direction),
        least_lag_(least_lag),
        // A bridge this long at twice the distance that counts as similar uses up what is allowed.
        allowed_drop_(static_cast<float>(constants.bridge_s * constants.rate)) {}

  /// Pixels after the start, in the order of exploration.
  std::vector<PlotPixel> run() {
    rows_.push_back({0, {0.0F}, {std::int8_t{-1}}});
    const long most_rows = direction_ > 0 ? x_.postures.rows() - start_.x : start_.x + 1;
    while (static_cast<long>(rows_.size()) < most_rows && explore_row()) {
    }
    return walk_back();
  }

 private:
  PlotPixel pixel(long row, long column) const {
    return {start_.x + direction_ * row, start_.y + direction_ * column};
  }

  /// 1 where the postures are the same, 0 from where on they are dissimilar, then negative.
  float likeness(const PlotPixel& at) const {
    const float distance = (x_.postures.row(at.x) - y_.postures.row(at.y)).norm();
    return 1 - distance / std::sqrt(x_.similar_mm[static_cast<std::size_t>(at.x)] *
                                    y_.similar_mm[static_cast<std::size_t>(at.y)]);
  }

  /// False once nothing can be reached any more.
  bool explore_row() {
    const long row = static_cast<long>(rows_.size());
    const long most_columns = direction_ > 0 ? y_.postures.rows() - start_.y : start_.y + 1;
    long first = std::numeric_limits<long>::max(), end = 0;
    for (const Step& step : steps) {
      if (step.x > row) continue;
      const Row& from = rows_[static_cast<std::size_t>(row - step.x)];
      if (from.score.empty()) continue;
      first = std::min(first, from.first + step.y);
      end = std::max(end, from.end() + step.y);
    }
    end = std::min(end, most_columns);
    if (first >= end) return false;
    Row next{first, {}, {}};
    for (long column = first; column < end; ++column) score_pixel(next, row, column);
    trim(next);
    rows_.push_back(std::move(next));
    return true;
  }

  void score_pixel(Row& next, long row, long column) {
    const PlotPixel at = pixel(row, column);
    float best = never;
    std::int8_t by = -1;
    if (least_lag_ == 0 || std::labs(at.x - at.y) >= least_lag_) {
      const float gain = likeness(at);
      for (std::size_t s = 0; s < steps.size(); ++s) {
        if (steps[s].x > row) continue;
        const float length = 0.5F * static_cast<float>(steps[s].x + steps[s].y);
        const float score =
            rows_[static_cast<std::size_t>(row - steps[s].x)].at(column - steps[s].y) +
            length * gain;
        if (score > best) {
          best = score;
          by = static_cast<std::int8_t>(s);
        }
      }
    }
    if (best > best_) {
      best_ = best;
      best_row_ = row;
      best_column_ = column;
    }
    next.score.push_back(best >= best_ - allowed_drop_ ? best : never);
    next.step.push_back(by);
  }

  static void trim(Row& row) {
    std::size_t first = 0, end = row.score.size();
    while (first < end && row.score[first] == never) ++first;
    while (end > first && row.score[end - 1] == never) --end;
    row.first += static_cast<long>(first);
    row.score = {row.score.begin() + static_cast<std::ptrdiff_t>(first),
                 row.score.begin() + static_cast<std::ptrdiff_t>(end)};
    row.step = {row.step.begin() + static_cast<std::ptrdiff_t>(first),
                row.step.begin() + static_cast<std::ptrdiff_t>(end)};
  }

  std::vector<PlotPixel> walk_back() const {
    std::vector<PlotPixel> pixels;
    long row = best_row_, column = best_column_;
    while (row > 0) {
      pixels.push_back(pixel(row, column));
      const Row& at = rows_[static_cast<std::size_t>(row)];
      const Step& step =
          steps[static_cast<std::size_t>(at.step[static_cast<std::size_t>(column - at.first)])];
      row -= step.x;
      column -= step.y;
    }
    std::reverse(pixels.begin(), pixels.end());
    return pixels;
  }

  const PlotSide& x_;
  const PlotSide& y_;
  PlotPixel start_;
  int direction_;
  long least_lag_;
  float allowed_drop_;
  std::vector<Row> rows_;
  float best_ = 0;
  long best_row_ = 0, best_column_ = 0;
};

}  // namespace

long SimilarPath::manhattan_length() const {
  if (pixels.empty()) return 0;
  return pixels.back().x - pixels.front().x + pixels.back().y - pixels.front().y;
}

SimilarPath trace_path(const PlotSide& x, const PlotSide& y, PlotPixel start, bool same_take,
                       const RepeatConstants& constants) {
  const long least_lag =
      same_take ? std::lround(std::ceil(constants.least_lag_s * constants.rate)) : 0;
  if (same_take && std::labs(start.x - start.y) < least_lag) return {};
  SimilarPath path;
  path.pixels = Explorer(x, y, start, -1, least_lag, constants).run();
  std::reverse(path.pixels.begin(), path.pixels.end());
  path.pixels.push_back(start);
  const auto after = Explorer(x, y, start, 1, least_lag, constants).run();
  path.pixels.insert(path.pixels.end(), after.begin(), after.end());
  float sum = 0;
  for (const PlotPixel& pixel : path.pixels) {
    sum += (x.postures.row(pixel.x) - y.postures.row(pixel.y)).norm();
  }
  path.mean_mm = sum / static_cast<float>(path.pixels.size());
  return path;
}

}  // namespace reprise
