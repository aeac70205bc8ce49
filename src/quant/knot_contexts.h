// Contexts of the decisions about a knot, and where their counters start.
#pragma once

#include <cstdint>

#include "quant/bit_model.h"
#include "quant/knot_order.h"

namespace reprise {

/// What is decided about a knot, one bit at a time.
enum KnotDecision : std::uint32_t {
  is_not_zero = 0,
  is_more_than = 1,  ///< 1 .. 6
  sign_is_negative = 7,
  decision_count = 8,
};

/// Numbers of values of what contexts are made of.
struct KnotContexts {
  static constexpr std::uint32_t slots = KnotSlots::count;
  static constexpr std::uint32_t columns = 72;
  static constexpr std::uint32_t magnitudes = 8;
  static constexpr std::uint32_t fine_magnitudes = 24;
  static constexpr std::uint32_t scales = 24;
  /// Contexts of one decision in each table. Of a magnitude, with the last part fastest: scale,
  /// slot; slot, before, parents; neighbours, before, parents; half the scale, fine sum of
  /// all; slot, column.
  static constexpr std::uint32_t count[BitModelConstants::inputs] = {
      scales * slots, slots* magnitudes* magnitudes, magnitudes* magnitudes* magnitudes,
      scales / 2 * fine_magnitudes, slots* columns};
};

/// Starts the counters of decisions about magnitudes where takes of other libraries would have
/// them: a short take ends before its counters have learned that much.
/// Counter c of decision d in table t is d * KnotContexts::count[t] + c.
void start_knot_counters(BitMixer& mixer);

}  // namespace reprise
