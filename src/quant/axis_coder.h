// Entries of mean and axes as bits, each as what it differs from what the markers before it say of
// it (docs/format-coefficients.md, Entries of axes).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "quant/axis_prediction.h"
#include "quant/bit_model.h"
#include "quant/range_coder.h"

namespace reprise {

/// How large the entries of an axis may be expected to be.
struct AxisScale {
  int size_class = 0;    ///< 0 .. 23: of entries that are all as large, in half octaves of a step
  int half_octaves = 0;  ///< how much finer its steps are than those of the axis before
};

/// A vector's entries one after the other, with what was learned of the vectors before it.
class AxisCoder {
 public:
  /// Entries beyond this are cut by an encoder, and no decoder gives any.
  static constexpr std::int32_t most_entry = 1 << 28;

  /// `mean` as AxisPredictor has it.
  AxisCoder(const MarkerLayout& layout, std::span<const std::int32_t> mean);

  /// `entries`: 3 a marker, in steps.
  void encode(RangeEncoder& encoder, const AxisScale& scale, std::span<const std::int32_t> entries);
  /// False for what no encoder wrote.
  bool decode(RangeDecoder& decoder, const AxisScale& scale, std::span<std::int32_t> entries);

 private:
  /// How entries are foretold. Persisted: never change a value.
  enum class Method : std::uint32_t { turned, half_turned, anchored, plain };
  static constexpr int method_bits = 2;
  static constexpr std::size_t methods = 4;

  template <class Io>
  bool walk(Io io, Method method, const AxisScale& scale, std::span<std::int32_t> entries);
  template <class Io>
  std::int32_t code_number(Io& io, std::int32_t value);
  /// Sets contexts for the number at `coordinate` of a marker that is `foretold` so.
  void expect(std::size_t marker, std::size_t coordinate, std::int64_t turned, std::int64_t base);
  void begin(const AxisScale& scale);

  AxisPredictor predictor_;
  BitMixer mixer_;
  int size_class_ = 0;
  /// Of each number: how large those at its place were in the axes before, in 1/64 steps.
  std::vector<std::int64_t> history_;
  std::vector<MarkerEntries> missed_;  ///< by what the numbers of each marker were foretold wrong
  std::array<std::uint32_t, BitModelConstants::inputs> sizes_{}, signs_{};  ///< contexts
};

}  // namespace reprise
