#include "exact/adaptive_prediction.h"

#include <algorithm>
#include <bit>

#include "exact/number_grid.h"

namespace reprise {
namespace {

using Constants = PredictionConstants;

/// value / 2^shift, rounded, within the limit of a feature.
std::int64_t scaled(std::int64_t value, int shift) {
  const std::int64_t half = (std::int64_t{1} << shift) >> 1;
  return std::clamp((value + half) >> shift, -Constants::most_feature, Constants::most_feature);
}

constexpr auto make_reciprocals() {
  std::array<std::int32_t, 128> table{};
  for (int i = 0; i < 128; ++i) table[i] = 65536 / (128 + i);
  return table;
}
constexpr auto reciprocals = make_reciprocals();

/// About slope x 2^weight_bits / power; a few parts in a thousand do not matter to a step.
std::int64_t divided(std::int64_t slope, std::int64_t power) {
  const auto positive = static_cast<std::uint64_t>(power + Constants::least_power);
  const int shift = static_cast<int>(std::bit_width(positive)) - 4;
  const std::uint64_t top = (positive << 4) >> shift;  // 128 to 255
  const std::int64_t limited = std::clamp(slope, -Constants::most_slope, Constants::most_slope);
  return limited * 16 * reciprocals[top & 127] >> shift;
}

/// Where the product of two features is, j being at most i.
constexpr std::size_t place_of(std::size_t i, std::size_t j) { return i * (i + 1) / 2 + j; }

}  // namespace

AdaptivePrediction::AdaptivePrediction(std::span<const ColumnReferences> references,
                                       std::span<const std::int64_t> starts)
    : columns_(references.size()) {
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    columns_[c].references = references[c];
    columns_[c].last = starts[c];
    for (std::size_t i = 0; i < Constants::features; ++i) {
      columns_[c].products[place_of(i, i)] = Constants::prior;
    }
  }
}

std::int64_t AdaptivePrediction::predict(std::size_t index) {
  Column& column = columns_[index];
  column.features[0] = column.change;
  column.features[1] = column.turn;
  for (std::size_t k = 0; k < most_references; ++k) {
    const std::uint32_t reference = column.references[k];
    column.features[2 + k] = reference == 0 ? 0 : columns_[reference - 1].turn;
  }
  std::int64_t sum = std::int64_t{1} << (Constants::weight_bits - 1);
  for (std::size_t i = 0; i < Constants::features; ++i) {
    sum += column.features[i] * column.weights[i];
  }
  column.expected_change = sum >> Constants::weight_bits;
  constexpr std::int64_t most = NumberGrid::most_magnitude - 1;
  return std::clamp(column.last + column.expected_change, -most, most);
}

void AdaptivePrediction::learn(std::size_t index, std::int64_t value) {
  Column& column = columns_[index];
  if (column.started) adapt(column, value - column.last - column.expected_change);
  skip(index, value);
}

void AdaptivePrediction::skip(std::size_t index, std::int64_t value) {
  Column& column = columns_[index];
  const std::int64_t change = column.started ? value - column.last : 0;
  column.turn = std::clamp(change - column.change, -Constants::most_change, Constants::most_change);
  column.change = change;
  column.last = value;
  column.started = true;
}

void AdaptivePrediction::adapt(Column& column, std::int64_t error) {
  constexpr std::size_t n = Constants::features;
  const std::int64_t magnitude = error < 0 ? -error : error;
  const auto size = static_cast<std::uint64_t>(
      std::max(column.mean_error >> 4, magnitude >> Constants::clip_bits));
  const int shift = std::max(0, static_cast<int>(std::bit_width(size)) - Constants::scale_bits);
  column.mean_error += (16 * magnitude - column.mean_error) >> Constants::scale_rate;

  const std::int64_t small_error = scaled(error, shift);
  Features x;
  for (std::size_t i = 0; i < n; ++i) x[i] = scaled(column.features[i], shift);
  Features slopes;
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t slope = column.slopes[i];
    slopes[i] = slope - (slope >> Constants::forgetting) + x[i] * small_error;
    for (std::size_t j = 0; j <= i; ++j) {
      std::int64_t& product = column.products[place_of(i, j)];
      product += x[i] * x[j] - (product >> Constants::forgetting);
    }
  }
  for (std::size_t i = column.first_moved; i < n; i += 2) {
    const std::int64_t step = divided(slopes[i], column.products[place_of(i, i)]);
    const std::int64_t weight = std::clamp<std::int64_t>(
        column.weights[i] + step, -Constants::most_weight, Constants::most_weight);
    const std::int64_t moved = weight - column.weights[i];
    column.weights[i] = static_cast<std::int32_t>(weight);
    for (std::size_t j = 0; j < n; ++j) {
      const std::int64_t product = column.products[i < j ? place_of(j, i) : place_of(i, j)];
      slopes[j] -= (product * moved) >> Constants::weight_bits;
    }
  }
  column.slopes = slopes;
  column.first_moved ^= 1;
}

}  // namespace reprise
