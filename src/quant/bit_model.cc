#include "quant/bit_model.h"

#include <algorithm>
#include <cassert>

namespace reprise {
namespace {

/// Costs of a bit of probability p in 1/65536 bit, by p / 16: log2 by repeated squaring.
constexpr auto make_cost_table() {
  std::array<std::uint32_t, 4096> table{};
  for (int i = 0; i < 4096; ++i) {
    double x = 65536.0 / (i * 16 + 8);
    std::uint32_t cost = 0;
    while (x >= 2) {
      x /= 2;
      cost += 65536;
    }
    for (std::uint32_t bit = 32768; bit > 0; bit /= 2) {
      x *= x;
      if (x >= 2) {
        x /= 2;
        cost += bit;
      }
    }
    table[i] = cost;
  }
  return table;
}
constexpr auto cost_table = make_cost_table();

}  // namespace

BitMixer::BitMixer(std::span<const std::size_t> table_sizes, std::size_t weight_sets)
    : weights_(weight_sets * BitModelConstants::inputs, weight_one * 3 / 10) {
  assert(table_sizes.size() == BitModelConstants::inputs);
  for (std::size_t t = 0; t < tables_.size(); ++t) tables_[t].resize(table_sizes[t]);
}

Probability BitMixer::predict(const Contexts& contexts) {
  const std::int32_t* weight = &weights_[contexts.weights * BitModelConstants::inputs];
  std::int64_t dot = 0;
  for (int i = 0; i < BitModelConstants::inputs; ++i) {
    stretched_[i] = stretch(tables_[i][contexts.counter[i]].probability);
    dot += static_cast<std::int64_t>(weight[i]) * stretched_[i];
  }
  const auto logit =
      static_cast<int>(std::clamp<std::int64_t>(dot >> 16, -logit_limit, logit_limit));
  predicted_ = static_cast<Probability>(squash(logit));
  return predicted_;
}

void BitMixer::update(const Contexts& contexts, bool bit) {
  std::int32_t* weight = &weights_[contexts.weights * BitModelConstants::inputs];
  const std::int32_t error =
      ((bit ? 65535 : 0) - static_cast<std::int32_t>(predicted_)) * BitModelConstants::mixer_rate;
  for (int i = 0; i < BitModelConstants::inputs; ++i) {
    weight[i] += static_cast<std::int32_t>(
        (static_cast<std::int64_t>(stretched_[i]) * error + (1 << 19)) >> 20);
    tables_[i][contexts.counter[i]].update(bit);
  }
}

void BitMixer::encode(RangeEncoder& encoder, const Contexts& contexts, bool bit) {
  encoder.encode(bit, predict(contexts));
  update(contexts, bit);
}

bool BitMixer::decode(RangeDecoder& decoder, const Contexts& contexts) {
  const bool bit = decoder.decode(predict(contexts));
  update(contexts, bit);
  return bit;
}

std::uint32_t BitMixer::learn(const Contexts& contexts, bool bit) {
  const std::uint32_t bits = cost(contexts, bit);
  update(contexts, bit);
  return bits;
}

std::uint32_t BitMixer::cost(const Contexts& contexts, bool bit) {
  const Probability one = predict(contexts);
  return cost_table[(bit ? one : 65536 - one) >> 4];
}

namespace {

/// Parts of a prior: probabilities as logits in steps of 1/4 nat, counts as their logarithm.
constexpr int prior_logit_step = logit_one / 4;
constexpr int prior_logit_limit = logit_limit / prior_logit_step;
constexpr int prior_logit_bits = 7;
constexpr int prior_count_bits = 3;
constexpr int prior_weight_step = weight_one / 32;
constexpr int prior_weight_limit = 127;
constexpr int prior_weight_bits = 8;
/// A context seen less often than this is not worth its bytes.
constexpr int least_prior_count = 4;

/// Bits of a small number, each in the context of those before it.
struct SymbolModel {
  explicit SymbolModel(int bits) : counters(std::size_t{1} << bits), width(bits) {}
  std::vector<BitCounter> counters;
  int width;

  template <class CodeBit>
  std::uint32_t code(std::uint32_t value, CodeBit&& code_bit) {
    std::uint32_t node = 1;
    for (int b = width - 1; b >= 0; --b) {
      const bool bit = code_bit(counters[node], (value >> b & 1) != 0);
      counters[node].update(bit);
      node = node << 1 | bit;
    }
    return node - (1u << width);
  }
};

int log2_floor(int value) {
  int result = 0;
  while (value > 1) value >>= 1, ++result;
  return result;
}

Probability probability_of(const BitCounter& counter) {
  return std::clamp<Probability>(counter.probability, least_probability, 65536 - least_probability);
}

/// Codes all counters and weights with `code_bit(counter, bit)`, which returns the bit, written or
/// read.
template <class Tables, class CodeBit>
void code_prior(Tables& tables, std::vector<std::int32_t>& weights, CodeBit&& code_bit) {
  SymbolModel logits(prior_logit_bits), counts(prior_count_bits), weight_model(prior_weight_bits);
  std::array<BitCounter, 4> seen;
  for (std::size_t t = 0; t + 1 < tables.size(); ++t) {
    unsigned history = 0;
    for (BitCounter& counter : tables[t]) {
      const bool used = code_bit(seen[history & 3], counter.count >= least_prior_count);
      seen[history & 3].update(used);
      history = history << 1 | used;
      if (!used) continue;
      const int logit = stretch(counter.probability);
      const int rounded = (logit + logit_limit + prior_logit_step / 2) / prior_logit_step;
      const auto stored = logits.code(static_cast<std::uint32_t>(rounded), code_bit);
      const auto sure = counts.code(
          static_cast<std::uint32_t>(log2_floor(std::max<int>(counter.count, 1))), code_bit);
      counter.probability = static_cast<std::uint16_t>(
          squash((static_cast<int>(stored) - prior_logit_limit) * prior_logit_step));
      counter.count =
          static_cast<std::uint16_t>(std::min(1 << sure, BitModelConstants::trained_count));
    }
  }
  for (std::int32_t& weight : weights) {
    const int rounded = std::clamp((weight + prior_weight_step / 2) / prior_weight_step,
                                   -prior_weight_limit, prior_weight_limit);
    const auto stored =
        weight_model.code(static_cast<std::uint32_t>(rounded + prior_weight_limit), code_bit);
    weight = (static_cast<int>(stored) - prior_weight_limit) * prior_weight_step;
  }
}

}  // namespace

void BitMixer::save(RangeEncoder& encoder) const {
  auto tables = tables_;
  auto weights = weights_;
  code_prior(tables, weights, [&](const BitCounter& counter, bool bit) {
    encoder.encode(bit, probability_of(counter));
    return bit;
  });
}

void BitMixer::load(RangeDecoder& decoder) {
  code_prior(tables_, weights_, [&](const BitCounter& counter, bool) {
    return decoder.decode(probability_of(counter));
  });
}

}  // namespace reprise
