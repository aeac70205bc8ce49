#include "quant/axis_coder.h"

#include <algorithm>
#include <cstdlib>

#include "quant/coded_bits.h"
#include "quant/magnitude_bins.h"

namespace reprise {
namespace {

// These belong to the archive format.

/// Counters of each table for one decision.
constexpr std::array<std::uint32_t, BitModelConstants::inputs> contexts = {24, 192, 192, 288, 192};
constexpr std::uint32_t last_bucket_decision = 24;
constexpr std::uint32_t first_low_decision = last_bucket_decision + 1;
constexpr std::uint32_t first_wide_bucket = 4, last_low_bucket = 14;
constexpr std::uint32_t sign_decision =
    first_low_decision + last_low_bucket - first_wide_bucket + 1;
constexpr std::uint32_t decisions = sign_decision + 1;
/// What was expected of numbers before there were any (1/64 steps), and the most (the same).
constexpr std::int64_t first_history = 4 * 64;
constexpr std::int64_t most_history = std::int64_t{1} << 34;
constexpr Learning learning = {30, 30, 65536 / 5};

std::array<std::size_t, BitModelConstants::inputs> table_sizes() {
  std::array<std::size_t, BitModelConstants::inputs> sizes;
  for (std::size_t t = 0; t < sizes.size(); ++t) sizes[t] = std::size_t{decisions} * contexts[t];
  return sizes;
}

std::uint32_t sign_of(std::int64_t value) { return value < 0 ? 1 : value > 0 ? 2 : 0; }

/// In steps that are finer by so many half octaves.
std::int64_t in_finer_steps(std::int64_t size, int half_octaves) {
  const int cut = std::clamp(half_octaves, -40, 40);
  const std::int64_t odd = (cut & 1) != 0 ? (size * root_of_two) >> 16 : size;
  const int octaves = cut >> 1;
  return std::min(octaves < 0 ? odd >> -octaves : odd << octaves, most_history);
}

}  // namespace

AxisCoder::AxisCoder(const MarkerLayout& layout, std::span<const std::int32_t> mean)
    : predictor_(layout, mean),
      mixer_(table_sizes(), decisions, learning),
      history_(3 * predictor_.markers(), first_history),
      missed_(predictor_.markers()) {}

void AxisCoder::encode(RangeEncoder& encoder, const AxisScale& scale,
                       std::span<const std::int32_t> entries) {
  std::vector<std::int32_t> cut(entries.begin(), entries.end());
  for (std::int32_t& entry : cut) entry = std::clamp(entry, -most_entry, most_entry);
  std::uint64_t least = ~std::uint64_t{0};
  Method best = Method::turned;
  for (std::size_t m = 0; m < methods; ++m) {
    const auto method = static_cast<Method>(m);
    AxisCoder trial = *this;
    std::vector<std::int32_t> copy = cut;
    std::uint64_t cost = 0;
    trial.walk(BitLearner{cost, trial.mixer_}, method, scale, copy);
    if (cost >= least) continue;
    least = cost;
    best = method;
  }
  encoder.encode_plain(static_cast<std::uint32_t>(best), method_bits);
  walk(BitWriter{encoder, mixer_}, best, scale, cut);
}

bool AxisCoder::decode(RangeDecoder& decoder, const AxisScale& scale,
                       std::span<std::int32_t> entries) {
  const auto method = static_cast<Method>(decoder.decode_plain(method_bits));
  return walk(BitReader{decoder, mixer_}, method, scale, entries);
}

void AxisCoder::begin(const AxisScale& scale) {
  size_class_ = std::clamp(scale.size_class, 0, static_cast<int>(contexts[0]) - 1);
  for (std::int64_t& size : history_) size = in_finer_steps(size, scale.half_octaves);
  predictor_.begin();
}

template <class Io>
bool AxisCoder::walk(Io io, Method method, const AxisScale& scale,
                     std::span<std::int32_t> entries) {
  begin(scale);
  const int quarters = method == Method::turned ? 4 : method == Method::half_turned ? 2 : 0;
  constexpr int bits = AxisPredictionConstants::turn_bits + 2;
  for (std::size_t m = 0; m < predictor_.markers(); ++m) {
    if constexpr (requires { io.ran_out(); }) {
      if (io.ran_out()) return false;
    }
    const AxisPredictor::Foretold foretold = predictor_.foretell(m);
    MarkerEntries coded{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int64_t turned =
          (quarters * foretold.turn[c] + (std::int64_t{1} << (bits - 1))) >> bits;
      const std::int64_t expected = method == Method::plain ? 0 : foretold.base[c] + turned;
      expect(m, c, expected - foretold.base[c], foretold.base[c]);
      std::int32_t& entry = entries[3 * m + c];
      const std::int32_t missed = code_number(io, static_cast<std::int32_t>(entry - expected));
      coded[c] = expected + missed;
      if (coded[c] < -most_entry || coded[c] > most_entry) return false;
      entry = static_cast<std::int32_t>(coded[c]);
      missed_[m][c] = missed;
      std::int64_t& size = history_[3 * m + c];
      size = (size + 64 * std::abs(std::int64_t{missed})) / 2;
    }
    predictor_.learn(m, coded);
  }
  return true;
}

void AxisCoder::expect(std::size_t marker, std::size_t coordinate, std::int64_t turned,
                       std::int64_t base) {
  const auto c = static_cast<std::uint32_t>(coordinate);
  const MarkerEntries& own = missed_[marker];
  const std::int64_t before = c > 0 ? own[c - 1] : 0, before_that = c > 1 ? own[c - 2] : 0;
  const std::int64_t a = std::abs(before), b = std::abs(before_that);
  std::int64_t beside = 0, beside_here = 0;
  if (const int neighbour = predictor_.neighbour(marker); neighbour >= 0) {
    const MarkerEntries& other = missed_[static_cast<std::size_t>(neighbour)];
    beside = std::abs(other[0]) + std::abs(other[1]) + std::abs(other[2]);
    beside_here = other[c];
  }
  const std::int64_t* history = &history_[3 * marker];
  const std::int64_t here = (history[c] + 32) / 64;
  const std::int64_t mean = (history[0] + history[1] + history[2] + 96) / 192;
  const std::int64_t sum = c == 0 ? 2 * beside / 3 + 2 * mean + 2 * here
                                  : beside / 3 + mean + 2 * here + (c == 1 ? 2 * a : a + b);
  const auto kind = static_cast<std::uint32_t>(predictor_.kind(marker));
  sizes_ = {static_cast<std::uint32_t>(size_class_),
            (magnitude_bin(a + b) * 8 + magnitude_bin(beside / 2)) * 3 + c,
            fine_magnitude_bin(here) * 8 + magnitude_bin(mean),
            fine_magnitude_bin(2 * here + mean) * 12 + c * 4 + kind, fine_magnitude_bin(sum)};
  const std::uint32_t both = sign_of(turned) * 3 + sign_of(base);
  signs_ = {0, both * 3 + c, (sign_of(beside_here) * 9 + both) * 3 + c,
            (sign_of(before) * 3 + sign_of(before_that)) * 3 + c,
            std::min(static_cast<std::uint32_t>(marker), contexts[4] - 1)};
}

template <class Io>
std::int32_t AxisCoder::code_number(Io& io, std::int32_t value) {
  const auto decide = [&](std::uint32_t decision, const auto& tables, bool bit) {
    BitMixer::Contexts chosen;
    for (std::size_t t = 0; t < tables.size(); ++t)
      chosen.counter[t] = decision * contexts[t] + tables[t];
    chosen.weights = decision;
    return io(chosen, bit);
  };
  const auto magnitude = static_cast<std::uint32_t>(std::abs(std::int64_t{value}));
  const std::uint32_t goal = bucket_of(magnitude);
  std::uint32_t index = 0;
  while (index < last_bucket &&
         decide(std::min(index, last_bucket_decision), sizes_, goal > index)) {
    ++index;
  }
  if (index == 0) return 0;
  const auto [first, bits] = bucket(index);
  std::uint32_t above = 0;  // above the bucket's first
  for (int i = bits - 1; i >= 0; --i) {
    const bool bit = (magnitude >> i & 1) != 0;
    const std::uint32_t low = std::min(index, last_low_bucket) - first_wide_bucket;
    above = above << 1 |
            (i == bits - 1 ? decide(first_low_decision + low, sizes_, bit) : io.plain(bit, 1) != 0);
  }
  const auto coded = static_cast<std::int32_t>(first + above);
  return decide(sign_decision, signs_, value < 0) ? -coded : coded;
}

}  // namespace reprise
