// What the knots of channels are told apart by, and where their counters start. All of this belongs
// to the archive format.
#pragma once

#include <array>
#include <cstdint>

#include "quant/bit_model.h"

namespace reprise {

struct ChannelContexts {
  static constexpr std::uint32_t level_slots = 14;
  static constexpr std::uint32_t bins = 24;  ///< of an expected magnitude
  static constexpr std::uint32_t few_bins = 8;
  static constexpr std::uint32_t most_channel = 255;  ///< later channels share contexts
  /// Is it beyond bucket 0, 1, ..; those from here on share their counters.
  static constexpr std::uint32_t decisions = 31;
  static constexpr std::uint32_t sign_decision = decisions, mantissa_decisions = decisions + 1;
  static constexpr std::uint32_t kinds = decisions + 1 + 2 * decisions;
  static constexpr std::array<std::uint32_t, BitModelConstants::inputs> count = {
      bins * level_slots, bins* few_bins, bins* few_bins, bins* few_bins* few_bins,
      (most_channel + 1) * level_slots};
};

/// A mixer as every take's channels start with it.
const BitMixer& fresh_channel_mixer();

}  // namespace reprise
