// Adaptive probabilities of binary decisions, mixed from several contexts in the logistic domain.
// Integers only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "quant/logit_tables.h"
#include "quant/range_coder.h"

namespace reprise {

/// More decisions than a byte can hold: one costs log2(65536 / (65536 - least_probability)) bits or
/// more, which makes 15,201 a byte.
constexpr std::size_t most_decisions_per_byte = 1u << 14;

/// How fast counters and mixers learn, and where weights start; docs/findings/ has what was tried.
struct Learning {
  int count_limit = BitModelConstants::count_limit;  ///< at most that
  int mixer_rate = BitModelConstants::mixer_rate;
  std::int32_t start_weight = weight_one * 3 / 10;  ///< of each table
};

/// A set of contexts and mixing weights. A decision names one counter of each of `inputs` tables,
/// and a set of weights: one of each of them, and one of a 1 for which nothing speaks.
class BitMixer {
 public:
  BitMixer(std::span<const std::size_t> table_sizes, std::size_t weight_sets,
           Learning learning = {});

  /// Learns on in another way.
  void learn_as(const Learning& learning) { learning_ = learning; }

  /// Starts a counter at `logit` (1/256 nat), as if it had seen `count` bits.
  void start(std::size_t table, std::size_t counter, int logit, int count);

  struct Contexts {
    std::array<std::uint32_t, BitModelConstants::inputs> counter;
    std::uint32_t weights = 0;
  };

  void encode(RangeEncoder& encoder, const Contexts& contexts, bool bit);
  bool decode(RangeDecoder& decoder, const Contexts& contexts) {
    const Prediction prediction = predict(contexts);
    const bool bit = decoder.decode(prediction.one);
    update(contexts, prediction, bit);
    return bit;
  }
  /// Learns as if `bit` had been coded; returns its cost in 1/65536 bit.
  std::uint32_t learn(const Contexts& contexts, bool bit);
  /// The cost alone.
  std::uint32_t cost(const Contexts& contexts, bool bit) const;

  /// Writes how what was learned differs from `fresh`, but for the last table, whose contexts are
  /// too many to be worth it.
  void save(RangeEncoder& encoder, const BitMixer& fresh) const;
  /// Starts from what was saved of a mixer, itself as `fresh` was.
  void load(RangeDecoder& decoder);

 private:
  static constexpr int inputs = BitModelConstants::inputs;
  static constexpr int weights_of_set = inputs + 1;

  /// What a decision's contexts say of it.
  struct Prediction {
    std::array<std::int32_t, weights_of_set> logits;
    Probability one;
  };
  Prediction predict(const Contexts& contexts) const;
  void update(const Contexts& contexts, const Prediction& prediction, bool bit);

  std::array<std::vector<BitCounter>, inputs> tables_;
  std::vector<std::int32_t> weights_;
  Learning learning_;
};

// Both stand here since decoding does little else.

inline BitMixer::Prediction BitMixer::predict(const Contexts& contexts) const {
  const std::int32_t* weights = &weights_[std::size_t{contexts.weights} * weights_of_set];
  Prediction result;
  result.logits[inputs] = logit_one;
  std::int64_t dot = static_cast<std::int64_t>(weights[inputs]) * logit_one;
  for (std::size_t i = 0; i < inputs; ++i) {
    result.logits[i] = stretch(tables_[i][contexts.counter[i]].probability);
    dot += static_cast<std::int64_t>(weights[i]) * result.logits[i];
  }
  const auto logit =
      static_cast<int>(std::clamp<std::int64_t>(dot >> 16, -logit_limit, logit_limit));
  result.one = static_cast<Probability>(squash(logit));
  return result;
}

inline void BitMixer::update(const Contexts& contexts, const Prediction& prediction, bool bit) {
  std::int32_t* weights = &weights_[std::size_t{contexts.weights} * weights_of_set];
  const std::int32_t error =
      ((bit ? 65535 : 0) - static_cast<std::int32_t>(prediction.one)) * learning_.mixer_rate;
  for (std::size_t i = 0; i < weights_of_set; ++i) {
    const auto move = static_cast<std::int32_t>(
        (static_cast<std::int64_t>(prediction.logits[i]) * error + (1 << 19)) >> 20);
    weights[i] = std::clamp(weights[i] + move, -weight_limit, weight_limit);
  }
  for (std::size_t i = 0; i < inputs; ++i)
    tables_[i][contexts.counter[i]].update(bit, learning_.count_limit);
}

}  // namespace reprise
