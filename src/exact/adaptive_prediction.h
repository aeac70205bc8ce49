// Each column's next value from its own last changes and from how earlier columns turned in the
// same row. Weights follow the motion while it is coded, by recursive least squares: half a sweep
// of Gauss-Seidel a row over exponentially forgotten normal equations. Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace reprise {

/// Earlier columns that help to predict one: each 0, or 1 + the column.
constexpr std::size_t most_references = 3;
using ColumnReferences = std::array<std::uint32_t, most_references>;

/// These belong to the format of exact texts; docs/findings/2026-11-25-exact-texts.md has what was
/// tried.
struct PredictionConstants {
  static constexpr std::size_t features = 2 + most_references;
  static constexpr int weight_bits = 16;  ///< weights are in 2^-16
  static constexpr std::int32_t most_weight = 8 << weight_bits;
  static constexpr int forgetting = 5;  ///< a row loses 1/32 of its say each row
  static constexpr int scale_bits = 5;  ///< of the mean error while weights are learned
  static constexpr int clip_bits = 2;   ///< an error four times as large has no more say
  static constexpr int scale_rate = 3;  ///< the mean error follows by 1/8 a row
  static constexpr std::int64_t most_feature = std::int64_t{1} << 18;  ///< while learning
  static constexpr std::int64_t most_change = std::int64_t{1} << 41;   ///< while predicting
  static constexpr std::int64_t most_slope = std::int64_t{1} << 46;    ///< no sum may overflow
  static constexpr std::int64_t least_power = 16;  ///< added to what steps are divided by
  static constexpr std::int64_t prior = 1 << 9;    ///< say of the first weights
};

class AdaptivePrediction {
 public:
  /// One column for each set of references, which are earlier columns, and each expected start.
  AdaptivePrediction(std::span<const ColumnReferences> references,
                     std::span<const std::int64_t> starts);

  /// What the next value of a column should be, those before it in the row being known.
  std::int64_t predict(std::size_t column);
  /// The value that it is, after `predict`.
  void learn(std::size_t column, std::int64_t value);
  /// The value of a column whose prediction nobody asked for.
  void skip(std::size_t column, std::int64_t value);

 private:
  using Features = std::array<std::int64_t, PredictionConstants::features>;
  struct Column {
    ColumnReferences references{};
    std::int64_t last = 0, change = 0, turn = 0;  ///< turn: the change of the change
    std::int64_t expected_change = 0;
    std::int64_t mean_error = 0;  ///< times 16
    bool started = false;
    Features features{};
    std::array<std::int32_t, PredictionConstants::features> weights{1 << 16};
    /// Sums over the rows so far of features times features, and of features times errors.
    std::array<std::int64_t, PredictionConstants::features*(PredictionConstants::features + 1) / 2>
        products{};
    Features slopes{};
    std::uint8_t first_moved = 0;  ///< a row moves every other weight, from this one on
  };
  static void adapt(Column& column, std::int64_t error);

  std::vector<Column> columns_;
};

}  // namespace reprise
