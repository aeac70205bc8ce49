// Probabilities as logits and back, and how fast counters learn: integers, made by basic
// operations alone, which every compiler rounds alike.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace reprise {

/// How fast counters and mixers learn; docs/findings/2026-11-24-preview-coder.md has what was
/// tried.
struct BitModelConstants {
  static constexpr int count_limit = 255;   ///< slowest rate of a counter: 1 / (limit + 1.5)
  static constexpr int trained_count = 12;  ///< how sure a counter from a prior is at most
  static constexpr int mixer_rate = 6;
  static constexpr int inputs = 5;  ///< contexts of one decision
};

/// Logits have 8 bits after the point and are cut at 11: a probability of 1 in 60,000.
constexpr int logit_one = 256;
constexpr int logit_limit = 11 * logit_one;
constexpr int weight_one = 65536;
/// Far beyond what motion brings: a damaged stream may push a weight for ever.
constexpr std::int32_t weight_limit = 64 * weight_one;
constexpr int least_probability = 24;

namespace logit_tables {

/// e^x by its series.
constexpr double exponential(double x) {
  constexpr int halvings = 6;
  double sum = 1, term = 1;
  const double small = x / (1 << halvings);
  for (int n = 1; n < 20; ++n) sum += (term *= small / n);
  for (int i = 0; i < halvings; ++i) sum *= sum;
  return sum;
}

constexpr auto make_squash_table() {
  std::array<std::uint16_t, 2 * logit_limit + 1> table{};
  for (int x = -logit_limit; x <= logit_limit; ++x) {
    const double p = 65536.0 / (1.0 + exponential(-static_cast<double>(x) / logit_one));
    table[x + logit_limit] = static_cast<std::uint16_t>(
        std::clamp(static_cast<int>(p + 0.5), least_probability, 65536 - least_probability));
  }
  return table;
}
inline constexpr auto squashed = make_squash_table();

constexpr auto make_stretch_table() {
  std::array<std::int16_t, 4096> table{};
  int logit = -logit_limit;
  for (int i = 0; i < 4096; ++i) {
    while (logit < logit_limit && squashed[logit + logit_limit] < i * 16 + 8) ++logit;
    table[i] = static_cast<std::int16_t>(logit);
  }
  return table;
}
inline constexpr auto stretched = make_stretch_table();

constexpr auto make_rate_table() {
  std::array<std::int32_t, BitModelConstants::count_limit + 1> table{};
  for (int n = 0; n <= BitModelConstants::count_limit; ++n) table[n] = 2 * 65536 / (2 * n + 3);
  return table;
}
inline constexpr auto rates = make_rate_table();

}  // namespace logit_tables

/// The probability of a logit, in 1/65536.
constexpr int squash(int logit) {
  return logit_tables::squashed[std::clamp(logit, -logit_limit, logit_limit) + logit_limit];
}
/// The logit of a probability in 1/65536.
constexpr int stretch(std::uint32_t probability) {
  return logit_tables::stretched[probability >> 4];
}

/// What one context has seen: a probability of a 1, and how sure it is of it.
struct BitCounter {
  std::uint16_t probability = 1u << 15;
  std::uint16_t count = 0;

  void update(bool bit, int count_limit = BitModelConstants::count_limit) {
    const std::int32_t target = bit ? 65535 : 0;
    const std::int64_t step =
        static_cast<std::int64_t>(target - probability) * logit_tables::rates[count];
    probability = static_cast<std::uint16_t>(probability + (step >> 16));
    if (count < count_limit) ++count;
  }
};

}  // namespace reprise
