#include "exact/linear_prediction.h"

#include <algorithm>

#include "exact/number_grid.h"
#include "quant/numbers.h"

namespace reprise {

PredictionState::PredictionState(const LinearPrediction& prediction, std::size_t columns)
    : prediction_(&prediction),
      columns_(columns),
      last_(columns),
      changes_(LinearPrediction::most_lag + 1, std::vector<std::int64_t>(columns)) {}

std::int64_t PredictionState::predict(std::size_t column) const {
  if (rows_ == 0) return last_[column];
  const auto& all = prediction_->terms;
  std::int64_t change = changes_[1][column];
  if (column < all.size() && !all[column].empty()) {
    // Sums may wrap where values are wild; they do so alike in every build.
    std::uint64_t sum = std::uint64_t{1} << (LinearPrediction::weight_bits - 1);
    for (const PredictionTerm& term : all[column]) {
      sum += static_cast<std::uint64_t>(static_cast<std::int64_t>(term.weight)) *
             static_cast<std::uint64_t>(changes_[term.lag][term.column]);
    }
    change = static_cast<std::int64_t>(sum) >> LinearPrediction::weight_bits;
  }
  constexpr std::int64_t most = NumberGrid::most_magnitude - 1;
  return std::clamp(last_[column] + change, -most, most);
}

void PredictionState::set(std::size_t column, std::int64_t value) {
  changes_[0][column] = rows_ == 0 ? 0 : value - last_[column];
  last_[column] = value;
}

void PredictionState::end_row() {
  std::rotate(changes_.begin(), changes_.end() - 1, changes_.end());
  ++rows_;
}

}  // namespace reprise
