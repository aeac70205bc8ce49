// The two directions of a walk over what is coded: the same steps write and read.
#pragma once

#include <algorithm>
#include <cstdint>

#include "exact/context_mixing.h"
#include "quant/numbers.h"
#include "quant/range_coder.h"

namespace reprise {

/// Limits of a probability that comes straight from a counter.
constexpr Probability least_counted = 24;

inline Probability counted(const BitCounter& counter) {
  return std::clamp<Probability>(counter.probability, least_counted, 65536 - least_counted);
}

/// Each step takes what is to be written and returns it.
class Writing {
 public:
  static constexpr bool reads = false;
  explicit Writing(RangeEncoder& coder) : coder_(coder) {}

  bool bit(BitCounter& counter, bool value) {
    coder_.encode(value, counted(counter));
    counter.update(value);
    return value;
  }
  template <std::size_t inputs>
  bool bit(MixedDecision<inputs> decision, bool value) {
    coder_.encode(value, decision.predict());
    decision.update(value);
    return value;
  }
  std::uint32_t uniform(std::uint32_t value, std::uint32_t total) {
    coder_.encode_uniform(value, total);
    return value;
  }
  /// At most 16 bits that are as likely as any others.
  std::uint32_t bits(std::uint32_t value, int count) {
    coder_.encode_bits(value, count);
    return value;
  }
  std::uint32_t number(std::uint32_t value) {
    encode_number(coder_, value);
    return value;
  }
  bool at_end() const { return false; }

 private:
  RangeEncoder& coder_;
};

/// Each step returns what was read, whatever it is given.
class Reading {
 public:
  static constexpr bool reads = true;
  explicit Reading(RangeDecoder& coder) : coder_(coder) {}

  bool bit(BitCounter& counter, bool) {
    const bool value = coder_.decode(counted(counter));
    counter.update(value);
    return value;
  }
  template <std::size_t inputs>
  bool bit(MixedDecision<inputs> decision, bool) {
    const bool value = coder_.decode(decision.predict());
    decision.update(value);
    return value;
  }
  std::uint32_t uniform(std::uint32_t, std::uint32_t total) { return coder_.decode_uniform(total); }
  std::uint32_t bits(std::uint32_t, int count) { return coder_.decode_bits(count); }
  std::uint32_t number(std::uint32_t) { return decode_number(coder_); }
  /// Whether so much was read that no encoder can have written it.
  bool at_end() const { return coder_.ran_out(); }

 private:
  RangeDecoder& coder_;
};

/// Bits of a value, high first, each in the context of those before: `counters` has 2^bits of them.
template <class Coding, class Counters>
std::uint32_t code_symbol(Coding& coding, Counters& counters, int bits, std::uint32_t value) {
  std::uint32_t node = 1;
  for (int b = bits - 1; b >= 0; --b) {
    node = node << 1 | coding.bit(counters[node], (value >> b & 1) != 0);
  }
  return node - (1u << bits);
}

/// A number below `total` that is as likely as any other.
template <class Coding>
std::uint64_t code_uniform(Coding& coding, std::uint64_t value, std::uint64_t total) {
  constexpr std::uint64_t most = 1u << 16;
  if (total <= 1) return 0;
  if (total <= most) {
    return coding.uniform(static_cast<std::uint32_t>(value), static_cast<std::uint32_t>(total));
  }
  // The high part, rounded up, then 16 bits.
  const std::uint64_t high = code_uniform(coding, value >> 16, (total + most - 1) >> 16);
  return high << 16 | coding.uniform(static_cast<std::uint32_t>(value & (most - 1)), most);
}

}  // namespace reprise
