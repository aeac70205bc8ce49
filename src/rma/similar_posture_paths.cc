#include "rma/similar_posture_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>

#include "rma/path_steps.h"

namespace reprise {
namespace {

constexpr float never = -std::numeric_limits<float>::infinity();

/// Half the Manhattan length of a step.
constexpr float length_of(const PathStep& step) {
  return 0.5F * static_cast<float>(step.x + step.y);
}

}  // namespace

/// Explores from one pixel towards one corner of a plot; the next time in the same memory.
class PathTracer::Explorer {
 public:
  explicit Explorer(const RepeatConstants& constants)
      // A bridge this long at twice the distance that counts as similar uses up what is allowed.
      : allowed_drop_(static_cast<float>(constants.bridge_s * constants.rate)) {}

  /// Pixels after the start, in the order of exploration.
  std::vector<PlotPixel> run(const PlotSide& x, const PlotSide& y, PlotPixel start, int direction,
                             long least_lag) {
    x_ = &x;
    y_ = &y;
    start_ = start;
    direction_ = direction;
    least_lag_ = least_lag;
    rows_.assign(1, {0, 1, 0});
    scores_.assign(1, 0.0F);
    steps_.assign(1, std::int8_t{-1});
    best_ = 0;
    best_row_ = best_column_ = 0;
    const long most_rows = direction > 0 ? x.postures.rows() - start.x : start.x + 1;
    while (static_cast<long>(rows_.size()) < most_rows && explore_row()) {
    }
    return walk_back();
  }

 private:
  /// One row of the explored part of a plot: its columns, and where their scores begin.
  struct Row {
    long first, end;
    std::size_t offset;
  };

  PlotPixel pixel(long row, long column) const {
    return {start_.x + direction_ * row, start_.y + direction_ * column};
  }

  /// 1 where the postures are the same, 0 from where on they are dissimilar, then negative.
  float likeness(const PlotPixel& at) const {
    const float distance = (x_->postures.row(at.x) - y_->postures.row(at.y)).norm();
    return 1 - distance / std::sqrt(x_->similar_mm[static_cast<std::size_t>(at.x)] *
                                    y_->similar_mm[static_cast<std::size_t>(at.y)]);
  }

  float score_at(const Row& row, long column) const {
    return column < row.first || column >= row.end
               ? never
               : scores_[row.offset + static_cast<std::size_t>(column - row.first)];
  }

  /// False once nothing can be reached any more.
  bool explore_row() {
    const long row = static_cast<long>(rows_.size());
    const long most_columns = direction_ > 0 ? y_->postures.rows() - start_.y : start_.y + 1;
    long first = std::numeric_limits<long>::max(), end = 0;
    for (const PathStep& step : path_steps) {
      if (step.x > row) continue;
      const Row& from = rows_[static_cast<std::size_t>(row - step.x)];
      if (from.first >= from.end) continue;
      first = std::min(first, from.first + step.y);
      end = std::max(end, from.end + step.y);
    }
    end = std::min(end, most_columns);
    if (first >= end) return false;
    Row next{first, first, scores_.size()};
    for (long column = first; column < end; ++column) {
      const bool kept = score_pixel(row, column);
      // Rows begin and end with what can be reached.
      if (kept) next.end = column + 1;
      if (!kept && next.first == column) {
        ++next.first;
        ++next.end;
        scores_.pop_back();
        steps_.pop_back();
      }
    }
    scores_.resize(next.offset + static_cast<std::size_t>(next.end - next.first));
    steps_.resize(scores_.size());
    rows_.push_back(next);
    return true;
  }

  /// Adds a pixel to the row; false: it cannot be reached.
  bool score_pixel(long row, long column) {
    std::array<float, path_steps.size()> from;
    float most = never;  // where the postures are the same
    for (std::size_t s = 0; s < path_steps.size(); ++s) {
      from[s] = path_steps[s].x > row
                    ? never
                    : score_at(rows_[static_cast<std::size_t>(row - path_steps[s].x)],
                               column - path_steps[s].y);
      most = std::max(most, from[s] + length_of(path_steps[s]));
    }
    const PlotPixel at = pixel(row, column);
    const bool allowed = least_lag_ == 0 || std::labs(at.x - at.y) >= least_lag_;
    float best = never;
    std::int8_t by = -1;
    if (allowed && most >= best_ - allowed_drop_) {
      const float gain = likeness(at);
      for (std::size_t s = 0; s < path_steps.size(); ++s) {
        const float score = from[s] + length_of(path_steps[s]) * gain;
        if (score <= best) continue;
        best = score;
        by = static_cast<std::int8_t>(s);
      }
    }
    if (best > best_) {
      best_ = best;
      best_row_ = row;
      best_column_ = column;
    }
    const bool kept = best >= best_ - allowed_drop_;
    scores_.push_back(kept ? best : never);
    steps_.push_back(by);
    return kept;
  }

  std::vector<PlotPixel> walk_back() const {
    std::vector<PlotPixel> pixels;
    long row = best_row_, column = best_column_;
    while (row > 0) {
      pixels.push_back(pixel(row, column));
      const Row& at = rows_[static_cast<std::size_t>(row)];
      const std::int8_t by = steps_[at.offset + static_cast<std::size_t>(column - at.first)];
      row -= path_steps[static_cast<std::size_t>(by)].x;
      column -= path_steps[static_cast<std::size_t>(by)].y;
    }
    std::reverse(pixels.begin(), pixels.end());
    return pixels;
  }

  float allowed_drop_;
  const PlotSide* x_ = nullptr;
  const PlotSide* y_ = nullptr;
  PlotPixel start_;
  int direction_ = 1;
  long least_lag_ = 0;
  std::vector<Row> rows_;
  std::vector<float> scores_;       // of all rows
  std::vector<std::int8_t> steps_;  // index into `path_steps`, by which each pixel was reached
  float best_ = 0;
  long best_row_ = 0, best_column_ = 0;
};

long SimilarPath::manhattan_length() const {
  if (pixels.empty()) return 0;
  return pixels.back().x - pixels.front().x + pixels.back().y - pixels.front().y;
}

PathTracer::PathTracer(const RepeatConstants& constants)
    : least_lag_(std::lround(std::ceil(constants.least_lag_s * constants.rate))),
      explorer_(std::make_unique<Explorer>(constants)) {}
PathTracer::~PathTracer() = default;

SimilarPath PathTracer::trace(const PlotSide& x, const PlotSide& y, PlotPixel start,
                              bool same_take) {
  const long least_lag = same_take ? least_lag_ : 0;
  if (same_take && std::labs(start.x - start.y) < least_lag) return {};
  SimilarPath path;
  path.pixels = explorer_->run(x, y, start, -1, least_lag);
  std::reverse(path.pixels.begin(), path.pixels.end());
  path.pixels.push_back(start);
  const auto after = explorer_->run(x, y, start, 1, least_lag);
  path.pixels.insert(path.pixels.end(), after.begin(), after.end());
  float sum = 0;
  for (const PlotPixel& pixel : path.pixels) {
    sum += (x.postures.row(pixel.x) - y.postures.row(pixel.y)).norm();
  }
  path.mean_mm = sum / static_cast<float>(path.pixels.size());
  return path;
}

}  // namespace reprise
