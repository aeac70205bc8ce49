// Each column's next change as a weighted sum of earlier changes, and of those of the columns
// before it in the same row. Weights are found in floating point once, stored as integers, and
// used in integers alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "quant/range_coder.h"

namespace reprise {

/// Values that predictions are made of: what a column's values are in the rows so far, in units.
struct PredictionTerm {
  std::uint32_t column = 0;
  std::uint8_t lag = 0;     ///< 0 (this row, earlier columns) to `most_lag`
  std::int32_t weight = 0;  ///< in 2^-weight_bits

  bool operator==(const PredictionTerm&) const = default;
};

struct LinearPrediction {
  static constexpr int most_lag = 3;
  static constexpr int weight_bits = 20;
  static constexpr std::size_t most_terms = 96;

  /// Of each column; one without terms is expected to change as it did last.
  std::vector<std::vector<PredictionTerm>> terms;

  bool operator==(const LinearPrediction&) const = default;
};

/// The changes of a take's columns, row by row.
using ColumnValues = std::vector<std::int64_t>;
struct TrainingTake {
  ColumnValues values;  ///< row by row
  std::size_t rows = 0;
};

/// Least squares over all takes. `steps` are how exact each column's numbers are, `active` the
/// columns that change. A term is taken only if it saves more bits than it costs.
LinearPrediction fit_prediction(std::span<const TrainingTake> takes, std::size_t columns,
                                std::span<const bool> active);

void encode_prediction(RangeEncoder& encoder, const LinearPrediction& prediction);
/// Throws Error (damaged) for terms that no encoder wrote.
LinearPrediction decode_prediction(RangeDecoder& decoder, std::size_t columns);

/// The last rows of a table while it is coded.
class PredictionState {
 public:
  PredictionState(const LinearPrediction& prediction, std::size_t columns);

  /// What the next value of a column should be; columns before it are known.
  std::int64_t predict(std::size_t column) const;
  void set(std::size_t column, std::int64_t value);
  void end_row();

 private:
  const LinearPrediction* prediction_;
  std::size_t columns_;
  std::size_t rows_ = 0;
  std::vector<std::int64_t> last_;                  ///< the row before
  std::vector<std::vector<std::int64_t>> changes_;  ///< of this row and those before it, by lag
};

}  // namespace reprise
