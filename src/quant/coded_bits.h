// What a walk over decisions does with each of them: writes it, reads it, or only learns from it.
#pragma once

#include <cstdint>

#include "quant/bit_model.h"
#include "quant/range_coder.h"

namespace reprise {

/// Each gives back the bit, or the lowest `count` bits, that a decoder has.
struct BitWriter {
  RangeEncoder& encoder;
  BitMixer& mixer;
  bool operator()(const BitMixer::Contexts& contexts, bool bit) {
    mixer.encode(encoder, contexts, bit);
    return bit;
  }
  std::uint32_t plain(std::uint32_t value, int count) {
    value &= (1u << count) - 1;
    encoder.encode_plain(value, count);
    return value;
  }
};

struct BitReader {
  RangeDecoder& decoder;
  BitMixer& mixer;
  bool operator()(const BitMixer::Contexts& contexts, bool) {
    return mixer.decode(decoder, contexts);
  }
  std::uint32_t plain(std::uint32_t, int count) { return decoder.decode_plain(count); }
  bool ran_out() const { return decoder.ran_out(); }
};

struct BitLearner {
  std::uint64_t& cost;  ///< in 1/65536 bits; what is learnt is added
  BitMixer& mixer;
  bool operator()(const BitMixer::Contexts& contexts, bool bit) {
    cost += mixer.learn(contexts, bit);
    return bit;
  }
  std::uint32_t plain(std::uint32_t value, int count) {
    cost += static_cast<std::uint64_t>(count) << 16;
    return value & ((1u << count) - 1);
  }
};

}  // namespace reprise
