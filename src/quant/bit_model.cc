#include "quant/bit_model.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>

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

std::uint32_t cost_of(Probability one, bool bit) {
  return cost_table[(bit ? one : 65536 - one) >> 4];
}

}  // namespace

BitMixer::BitMixer(std::span<const std::size_t> table_sizes, std::size_t weight_sets,
                   Learning learning)
    : weights_(weight_sets * weights_of_set, learning.start_weight), learning_(learning) {
  assert(table_sizes.size() == BitModelConstants::inputs);
  for (std::size_t s = 0; s < weight_sets; ++s) weights_[s * weights_of_set + inputs] = 0;
  for (std::size_t t = 0; t < tables_.size(); ++t) tables_[t].resize(table_sizes[t]);
}

void BitMixer::start(std::size_t table, std::size_t counter, int logit, int count) {
  tables_[table][counter] = {static_cast<std::uint16_t>(squash(logit)),
                             static_cast<std::uint16_t>(count)};
}

void BitMixer::encode(RangeEncoder& encoder, const Contexts& contexts, bool bit) {
  const Prediction prediction = predict(contexts);
  encoder.encode(bit, prediction.one);
  update(contexts, prediction, bit);
}

std::uint32_t BitMixer::learn(const Contexts& contexts, bool bit) {
  const Prediction prediction = predict(contexts);
  update(contexts, prediction, bit);
  return cost_of(prediction.one, bit);
}

std::uint32_t BitMixer::cost(const Contexts& contexts, bool bit) const {
  return cost_of(predict(contexts).one, bit);
}

namespace {

/// Parts of a prior: probabilities as logits in steps of 1/4 nat from the fresh one, counts as
/// their logarithm.
constexpr int prior_logit_step = logit_one / 4;
constexpr int prior_logit_limit = 63;
constexpr int prior_logit_bits = 7;
constexpr int prior_count_bits = 3;
/// A context seen less often than this, or moved less from where it starts, is not worth its bytes.
constexpr int least_prior_count = 6;
constexpr int least_prior_move = 2;

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

int quarter_nats(const BitCounter& counter) {
  const int logit = stretch(counter.probability);
  return (logit + logit_limit + prior_logit_step / 2) / prior_logit_step -
         logit_limit / prior_logit_step;
}

/// Codes counters, by what they differ from those of `fresh`, with `code_bit(counter, bit)`, which
/// returns the bit, written or read. Weights stay where they start: those that takes of one library
/// end with made others larger.
template <class Tables, class CodeBit>
void code_prior(const Tables& fresh, Tables& tables, CodeBit&& code_bit) {
  SymbolModel logits(prior_logit_bits), counts(prior_count_bits);
  std::array<BitCounter, 4> seen;
  for (std::size_t t = 0; t + 1 < tables.size(); ++t) {
    unsigned history = 0;
    for (std::size_t i = 0; i < tables[t].size(); ++i) {
      BitCounter& counter = tables[t][i];
      const int expected = quarter_nats(fresh[t][i]);
      const int moved =
          std::clamp(quarter_nats(counter) - expected, -prior_logit_limit, prior_logit_limit);
      const bool pays = counter.count >= least_prior_count && std::abs(moved) >= least_prior_move;
      const bool used = code_bit(seen[history & 3], pays);
      seen[history & 3].update(used);
      history = history << 1 | used;
      if (!used) continue;
      const auto stored =
          logits.code(static_cast<std::uint32_t>(moved + prior_logit_limit), code_bit);
      const auto sure = counts.code(
          static_cast<std::uint32_t>(log2_floor(std::max<int>(counter.count, 1))), code_bit);
      counter.probability = static_cast<std::uint16_t>(
          squash((expected + static_cast<int>(stored) - prior_logit_limit) * prior_logit_step));
      counter.count =
          static_cast<std::uint16_t>(std::min(1 << sure, BitModelConstants::trained_count));
    }
  }
}

}  // namespace

void BitMixer::save(RangeEncoder& encoder, const BitMixer& fresh) const {
  auto tables = tables_;
  code_prior(fresh.tables_, tables, [&](const BitCounter& counter, bool bit) {
    encoder.encode(bit, probability_of(counter));
    return bit;
  });
}

void BitMixer::load(RangeDecoder& decoder) {
  const auto fresh = tables_;
  code_prior(fresh, tables_, [&](const BitCounter& counter, bool) {
    return decoder.decode(probability_of(counter));
  });
}

}  // namespace reprise
