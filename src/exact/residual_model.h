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
  constexpr std::array<std::uint8_t, 8> quarters = {0, 0, 1, 1, 2, 2, 3, 3};
  return 4 * width + quarters[top & 7];
}

/// What a channel's residuals were like; units of its values.
struct ResidualHistory {
  std::int64_t fast = 0;  ///< means of their magnitudes, times 16
  std::int64_t slow = 0;
  std::array<std::uint8_t, 2> widths{};  ///< of the last ones, in steps of the grid
  std::uint8_t sign = 0;                 ///< of the last one: 0 none, 1 positive, 2 negative

  void update(std::int64_t magnitude) {
    constexpr int fast_rate = 2, slow_rate = 5;
    const std::int64_t target = magnitude * 16;
    fast += (target - fast) / (1 << fast_rate);
    slow += (target - slow) / (1 << slow_rate);
  }
};

class ResidualModel {
 public:
  explicit ResidualModel(std::size_t channels)
      : mixer_(std::array<std::size_t, 5>{128 * nodes, widths * activities * nodes,
                                          8 * 8 * 4 * nodes, 8 * widths * nodes, channels * nodes},
               nodes * 4) {}

  /// A new frame begins.
  void begin_frame() { activity_ = activity_ * 3 / 4; }

  /// Codes a residual in steps of a grid whose steps are 2^(log_step / 4) units.
  template <class Coding>
  std::int64_t code(Coding& coding, std::size_t channel, ResidualHistory& history, int log_step,
                    std::int64_t residual);

  BitMixer& mixer() { return mixer_; }

 private:
  static constexpr int nodes = 16;
  static constexpr int widths = 48;
  static constexpr int activities = 8;
  static constexpr int most_width = 43;

  BitMixer mixer_;
  std::array<BitCounter, 9> signs_;
  std::array<BitCounter, widths * 8> first_bits_;
  std::array<BitCounter, widths * 16> second_bits_;
  int activity_ = 0;  ///< how much wider this frame's residuals are than expected, in 1/16 bit
};

template <class Coding>
std::int64_t ResidualModel::code(Coding& coding, std::size_t channel, ResidualHistory& history,
                                 int log_step, std::int64_t residual) {
  // Histories are in 1/16 units, so that 16 is 4 x 4 too much; a width is one more than a log.
  const int fast = log4_of(static_cast<std::uint64_t>(history.fast));
  const int slow = log4_of(static_cast<std::uint64_t>(history.slow));
  const int scale = std::clamp(
      log4_of(static_cast<std::uint64_t>(history.fast + history.slow) / 2) - 8 - log_step, 0, 127);
  const int expected = std::min(scale / 4, widths - 1);
  const int small = std::min(expected, 3);
  const int activity = std::clamp((activity_ + 72) / 18, 0, activities - 1);
  const auto relative = [&](int width) { return std::clamp(width - expected + 5, 0, 7); };
  const int change = std::clamp((fast - slow) / 3 + 4, 0, 7);
  const auto context = static_cast<std::uint32_t>(
      (relative(history.widths[0]) * 8 + relative(history.widths[1])) * 4 + small);
  BitMixer::Contexts contexts;
  const auto wider = [&](int width, bool is) {
    const auto node = static_cast<std::uint32_t>(std::clamp(width - expected + 7, 0, nodes - 1));
    contexts.counter = {static_cast<std::uint32_t>(scale) * nodes + node,
                        static_cast<std::uint32_t>(expected * activities + activity) * nodes + node,
                        context * nodes + node,
                        static_cast<std::uint32_t>(change * widths + expected) * nodes + node,
                        static_cast<std::uint32_t>(channel) * nodes + node};
    contexts.weights = node * 4 + static_cast<std::uint32_t>(small);
    return coding.bit(mixer_, contexts, is);
  };

  const std::uint64_t magnitude = static_cast<std::uint64_t>(residual < 0 ? -residual : residual);
  const int given = static_cast<int>(std::bit_width(magnitude));
  int width = std::max(expected, 1);
  if (wider(width, given >= width)) {
    while (width < most_width && wider(width + 1, given > width)) ++width;
  } else {
    --width;
    while (width > 0 && !wider(width, given >= width)) --width;
  }
  activity_ += ((width - expected) * 16 - activity_) / 8;
  history.widths = {static_cast<std::uint8_t>(width), history.widths[0]};
  if (width == 0) {
    history.sign = 0;
    return 0;
  }
  const bool negative = coding.bit(signs_[history.sign], residual < 0);
  history.sign = negative ? 2 : 1;
  std::uint64_t value = 1;
  int rest = width - 1;
  const int around = std::clamp(width - expected + 4, 0, 7);
  if (rest > 0) {
    --rest;
    value = value << 1 | coding.bit(first_bits_[width * 8 + around], (magnitude >> rest & 1) != 0);
  }
  if (rest > 0) {
    --rest;
    value = value << 1 | coding.bit(second_bits_[(width * 8 + around) * 2 + (value & 1)],
                                    (magnitude >> rest & 1) != 0);
  }
  while (rest > 0) {
    const int count = std::min(rest, 16);
    rest -= count;
    const auto part = static_cast<std::uint32_t>(magnitude >> rest & ((1u << count) - 1));
    value = value << count | coding.uniform(part, 1u << count);
  }
  const auto wide = static_cast<std::int64_t>(value);
  return negative ? -wide : wide;
}

}  // namespace reprise
