#include "refine/step_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "quant/bit_model.h"
#include "quant/numbers.h"

namespace reprise {
namespace {

using Eigen::Index;
using Constants = StepConstants;

constexpr std::size_t most_bytes_past_end = 16;

std::array<double, Constants::most + 1> make_steps() {
  constexpr double eighths[Constants::per_octave] = {1.0,
                                                     1.0905077326652577,
                                                     1.1892071150027210,
                                                     1.2968395546510096,
                                                     1.4142135623730951,
                                                     1.5422108254079407,
                                                     1.6817928305074290,
                                                     1.8340080864093424};
  std::array<double, Constants::most + 1> steps{};
  for (int i = 0; i <= Constants::most; ++i) {
    steps[static_cast<std::size_t>(i)] =
        std::ldexp(eighths[i % Constants::per_octave],
                   i / Constants::per_octave - Constants::one / Constants::per_octave);
  }
  return steps;
}

/// Differences of offsets from the block before: zero, sign, size in unary.
constexpr int unary_limit = Constants::most_offset - Constants::least_offset;
constexpr std::size_t contexts = 9;

struct OffsetModel {
  std::array<BitCounter, contexts> zero, sign;
  std::array<std::array<BitCounter, 4>, contexts> more;

  template <class CodeBit>
  int code(int value, std::size_t context, CodeBit&& code_bit) {
    const auto decide = [&](BitCounter& counter, bool bit) {
      bit = code_bit(std::clamp<Probability>(counter.probability, 64, 65472), bit);
      counter.update(bit);
      return bit;
    };
    if (!decide(zero[context], value != 0)) return 0;
    const bool negative = decide(sign[context], value < 0);
    int size = 1;
    while (size < unary_limit &&
           decide(more[context][static_cast<std::size_t>(std::min(size, 4) - 1)],
                  std::abs(value) > size)) {
      ++size;
    }
    return negative ? -size : size;
  }
};

/// Codes all offsets with `code_bit(probability, bit)`, which returns the bit, written or read.
template <class Offsets, class CodeBit>
void code_offsets(Offsets& offsets, const std::vector<int>& parents, CodeBit&& code_bit) {
  OffsetModel model;
  const auto change = [&](Index b, Index g) {
    return g < 0 ? 0 : offsets(b, g) - (b > 0 ? offsets(b - 1, g) : 0);
  };
  for (Index b = 0; b < offsets.rows(); ++b) {
    for (Index g = 0; g < offsets.cols(); ++g) {
      const auto of_sign = [](int v) {
        return static_cast<std::size_t>(v < 0 ? 0 : v > 0 ? 2 : 1);
      };
      const int before = b > 0 ? offsets(b - 1, g) : 0;
      const std::size_t context =
          of_sign(change(b, parents[static_cast<std::size_t>(g)])) * 3 + of_sign(before);
      const int value = before + model.code(offsets(b, g) - before, context, code_bit);
      offsets(b, g) = static_cast<std::int8_t>(
          std::clamp(value, Constants::least_offset, Constants::most_offset));
    }
  }
}

}  // namespace

double step_of(int index) {
  static const std::array<double, Constants::most + 1> steps = make_steps();
  return steps[static_cast<std::size_t>(std::clamp(index, 0, Constants::most))];
}

int step_index(double step) {
  if (!(step > 0)) return 0;
  const double octaves = std::clamp(std::log2(step), -60.0, 60.0);
  return std::clamp(static_cast<int>(std::lround(octaves * Constants::per_octave)) + Constants::one,
                    0, Constants::most);
}

StepGrid::StepGrid(const Skeleton& skeleton, long frames, int levels)
    : levels_(levels), half_((Index{1} << levels) / 2) {
  std::vector<int> group_of_joint;
  for (const Joint& joint : skeleton.joints) {
    const int above =
        joint.parent < 0 ? -1 : group_of_joint[static_cast<std::size_t>(joint.parent)];
    if (joint.channels.empty()) {
      group_of_joint.push_back(above);
      continue;
    }
    group_of_joint.push_back(static_cast<int>(parents_.size()));
    parents_.push_back(above);
    groups_.insert(groups_.end(), joint.channels.size(), group_of_joint.back());
  }
  base.assign(groups_.size(), Constants::one);
  offsets.setZero(block(frames - 1) + 1, static_cast<Index>(parents_.size()));
}

void StepGrid::encode(RangeEncoder& encoder) const {
  int before = Constants::one;
  for (const int index : base) {
    encoder.encode_plain(index < 0, 1);
    if (index < 0) continue;
    encode_signed(encoder, index - before);
    before = index;
  }
  auto copy = offsets;
  code_offsets(copy, parents_, [&](Probability one, bool bit) {
    encoder.encode(bit, one);
    return bit;
  });
}

bool StepGrid::decode(RangeDecoder& decoder) {
  std::int64_t before = Constants::one;
  for (int& index : base) {
    index = -1;
    if (decoder.decode_plain(1) != 0) continue;
    before += decode_signed(decoder);
    if (before < 0 || before > Constants::most) return false;
    if (decoder.bytes_past_end() > most_bytes_past_end) return false;
    index = static_cast<int>(before);
  }
  code_offsets(offsets, parents_, [&](Probability one, bool) { return decoder.decode(one); });
  return decoder.bytes_past_end() <= most_bytes_past_end;
}

}  // namespace reprise
