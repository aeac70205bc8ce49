// A decision mixed from several contexts in the logistic domain, inline, since a text has tens of
// millions of them. Integers only.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "quant/logit_tables.h"
#include "quant/range_coder.h"

namespace reprise {

/// Weights of one kind of decision, in 1/65536.
template <std::size_t inputs>
struct MixingWeights {
  static constexpr std::int32_t first = weight_one * 3 / 2 / static_cast<int>(inputs);
  std::array<std::int32_t, inputs> values;
  MixingWeights() { values.fill(first); }
};

/// One decision: the counters of its contexts, and the weights of its kind.
template <std::size_t inputs>
struct MixedDecision {
  std::array<BitCounter*, inputs> counters;
  MixingWeights<inputs>* weights;
  std::array<std::int32_t, inputs> logits{};
  Probability predicted = 0;

  Probability predict() {
    std::int64_t dot = 0;
    for (std::size_t i = 0; i < inputs; ++i) {
      logits[i] = stretch(counters[i]->probability);
      dot += static_cast<std::int64_t>(weights->values[i]) * logits[i];
    }
    predicted = static_cast<Probability>(
        squash(static_cast<int>(std::clamp<std::int64_t>(dot >> 16, -logit_limit, logit_limit))));
    return predicted;
  }

  void update(bool bit) {
    const std::int32_t error =
        ((bit ? 65535 : 0) - static_cast<std::int32_t>(predicted)) * BitModelConstants::mixer_rate;
    for (std::size_t i = 0; i < inputs; ++i) {
      weights->values[i] += static_cast<std::int32_t>(
          (static_cast<std::int64_t>(logits[i]) * error + (1 << 19)) >> 20);
      counters[i]->update(bit);
    }
  }
};

}  // namespace reprise
