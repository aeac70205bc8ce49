// Whole numbers around zero that learn how large they are: zero, sign, size in unary
// (docs/format.md, Bits).
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>

#include "quant/bit_model.h"

namespace reprise {

struct SmallNumber {
  /// Sizes beyond this are cut.
  static constexpr int most = 260;

  BitCounter zero, sign;
  std::array<BitCounter, 6> more;

  /// `code_bit(probability, bit)` returns the bit, written or read.
  template <class CodeBit>
  int code(int value, CodeBit&& code_bit) {
    const auto decide = [&](BitCounter& counter, bool bit) {
      bit = code_bit(std::clamp<Probability>(counter.probability, 64, 65472), bit);
      counter.update(bit);
      return bit;
    };
    if (!decide(zero, value != 0)) return 0;
    const bool negative = decide(sign, value < 0);
    int size = 1;
    while (size < most &&
           decide(more[std::min<std::size_t>(static_cast<std::size_t>(size), more.size()) - 1],
                  std::abs(value) > size)) {
      ++size;
    }
    return negative ? -size : size;
  }
};

}  // namespace reprise
