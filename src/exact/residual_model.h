// How far numbers are from what was expected of them.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "exact/coding.h"

namespace reprise {

/// 4 log2 of a number of at least 0; 0 and 1 both give 0.
inline int log4_of(std::uint64_t value) {
  if (value < 2) return 0;
  const int width = static_cast<int>(std::bit_width(value)) - 1;
  const auto top = static_cast<unsigned>(width >= 3 ? value >> (width - 3) : value << (3 - width));
  return 4 * width + static_cast<int>((top & 7) >> 1);
}

/// What a channel's residuals were like; units of its values.
struct ResidualHistory {
  std::int32_t fast = 0;  ///< means of the logarithms of their magnitudes, in 1/64 bit
  std::int32_t slow = 0;
  std::uint8_t count = 0;                ///< of residuals so far
  std::array<std::uint8_t, 2> widths{};  ///< of the last ones, in steps of the grid

  void update(std::int64_t magnitude) {
    constexpr int fast_rate = 2, slow_rate = 5;
    const int target = 16 * log4_of(static_cast<std::uint64_t>(magnitude));
    // The first two are a whole value and a whole change.
    if (count < 2) fast = slow = target;
    fast += (target - fast) / (1 << fast_rate);
    slow += (target - slow) / (1 << std::clamp<int>(std::bit_width(count), fast_rate, slow_rate));
    if (count < 255) ++count;
  }
};

/// A residual's magnitude has a width in bits, coded upwards or downwards from the width of those
/// before; its highest bit below the leading one is coded, too, and the rest and the sign are
/// plain.
class ResidualModel {
 public:
  explicit ResidualModel(std::size_t channels)
      : rows_(first_state(widths * activities)),
        lasts_(first_state(8 * 8 * 4)),
        channels_(first_state(channels)),
        weights_(nodes * 4) {}

  /// A new frame begins.
  void begin_frame() { activity_ = activity_ * 3 / 4; }

  /// Codes a residual in steps of a grid whose steps are 2^(log_step / 4) units.
  template <class Coding>
  std::int64_t code(Coding& coding, std::size_t channel, ResidualHistory& history, int log_step,
                    std::int64_t residual);

 private:
  static constexpr int nodes = 16;
  static constexpr int center = 7;  ///< the node of the expected width
  static constexpr int widths = 44;
  static constexpr int activities = 8;
  static constexpr int most_width = 43;
  static constexpr std::size_t inputs = 3;

  /// Counters start with how widths of motion are distributed on average (all three sets), so
  /// that short takes lose little until theirs are known.
  static std::vector<BitCounter> first_state(std::size_t contexts) {
    constexpr std::array<std::uint16_t, nodes> usual = {30000, 30000, 30000, 30000, 30000, 30000,
                                                        30000, 41000, 41000, 29000, 16400, 10000,
                                                        20000, 20000, 20000, 20000};
    constexpr std::uint16_t sure = 4;
    std::vector<BitCounter> counters(contexts * nodes);
    for (std::size_t i = 0; i < counters.size(); ++i) counters[i] = {usual[i % nodes], sure};
    return counters;
  }

  template <class Coding>
  int code_width(Coding& coding, std::array<BitCounter*, inputs> contexts, int expected, int given);
  template <class Coding>
  std::int64_t code_below(Coding& coding, int width, int around, std::int64_t residual);

  std::vector<BitCounter> rows_, lasts_, channels_;
  std::vector<MixingWeights<inputs>> weights_;
  std::array<BitCounter, widths * 8> first_bits_;
  int activity_ = 0;  ///< how much wider this frame's residuals are than expected, in 1/16 bit
};

template <class Coding>
std::int64_t ResidualModel::code(Coding& coding, std::size_t channel, ResidualHistory& history,
                                 int log_step, std::int64_t residual) {
  // Means are times 16: 4 x 4 in quarters of a bit.
  const int expected =
      std::clamp((history.fast + history.slow - 32 * log_step + 160) >> 7, 0, widths - 1);
  const int activity = std::clamp((activity_ + 72) / 18, 0, activities - 1);
  const auto relative = [&](int width) { return std::clamp(width - expected + 3, 0, 7); };
  const int lasts =
      (relative(history.widths[0]) * 8 + relative(history.widths[1])) * 4 + std::min(expected, 3);
  const std::array<BitCounter*, inputs> contexts = {
      &rows_[static_cast<std::size_t>((expected * activities + activity) * nodes)],
      &lasts_[static_cast<std::size_t>(lasts * nodes)], &channels_[channel * nodes]};
  const auto magnitude = static_cast<std::uint64_t>(residual < 0 ? -residual : residual);
  const int width =
      code_width(coding, contexts, expected, static_cast<int>(std::bit_width(magnitude)));
  activity_ += ((width - expected) * 16 - activity_) / 8;
  history.widths = {static_cast<std::uint8_t>(width), history.widths[0]};
  if (width == 0) return 0;
  return code_below(coding, width, std::clamp(width - expected + 2, 0, 7), residual);
}

template <class Coding>
int ResidualModel::code_width(Coding& coding, std::array<BitCounter*, inputs> contexts,
                              int expected, int given) {
  const int small = std::min(expected, 3);
  const auto at_least = [&](int width) {
    const int node = std::clamp(width - expected + center, 0, nodes - 1);
    MixedDecision<inputs> decision;
    for (std::size_t i = 0; i < inputs; ++i) decision.counters[i] = contexts[i] + node;
    decision.weights = &weights_[static_cast<std::size_t>(node * 4 + small)];
    return coding.bit(decision, given >= width);
  };
  int width = std::max(expected, 1);
  if (at_least(width)) {
    while (width < most_width && at_least(width + 1)) ++width;
    return width;
  }
  --width;
  while (width > 0 && !at_least(width)) --width;
  return width;
}

template <class Coding>
std::int64_t ResidualModel::code_below(Coding& coding, int width, int around,
                                       std::int64_t residual) {
  const auto magnitude = static_cast<std::uint64_t>(residual < 0 ? -residual : residual);
  std::uint64_t value = 1;
  int rest = width - 1;
  if (rest > 0) {
    --rest;
    value = value << 1 | coding.bit(first_bits_[width * 8 + around], (magnitude >> rest & 1) != 0);
  }
  // The sign is the lowest of the plain bits.
  const std::uint64_t plain = magnitude << 1 | (residual < 0 ? 1 : 0);
  for (++rest; rest > 0;) {
    const int count = std::min(rest, 16);
    rest -= count;
    const auto part = static_cast<std::uint32_t>(plain >> rest & ((1u << count) - 1));
    value = value << count | coding.bits(part, count);
  }
  const auto wide = static_cast<std::int64_t>(value >> 1);
  return (value & 1) != 0 ? -wide : wide;
}

}  // namespace reprise
