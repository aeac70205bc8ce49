#include "refine/step_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "quant/small_number.h"

namespace reprise {
namespace {

using Eigen::Index;
using Constants = StepConstants;

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

/// Codes the steps of all channels with `code_bit(probability, bit)`, which returns the bit,
/// written or read. False: there are no such steps.
template <class CodeBit>
bool code_base(std::vector<int>& base, const std::vector<bool>& turns, CodeBit&& code_bit) {
  constexpr int most = Constants::most / Constants::per_base;
  std::array<SmallNumber, 2> models;
  std::array<int, 2> before;
  before.fill(Constants::one / Constants::per_base);
  BitCounter stored;
  for (std::size_t i = 0; i < base.size(); ++i) {
    const bool is_stored =
        code_bit(std::clamp<Probability>(stored.probability, 64, 65472), base[i] < 0);
    stored.update(is_stored);
    const std::size_t kind = turns[i];
    if (is_stored) {
      base[i] = -1;
      continue;
    }
    before[kind] += models[kind].code(base[i] / Constants::per_base - before[kind], code_bit);
    if (before[kind] < 0 || before[kind] > most) return false;
    base[i] = before[kind] * Constants::per_base;
  }
  return true;
}

constexpr std::size_t contexts = 9;

/// Codes all offsets with `code_bit(probability, bit)`, which returns the bit, written or read.
template <class Offsets, class CodeBit>
void code_offsets(Offsets& offsets, const std::vector<int>& parents, CodeBit&& code_bit) {
  std::array<SmallNumber, contexts> models;
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
      const int value = before + models[context].code(offsets(b, g) - before, code_bit);
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
  constexpr double per_octave = Constants::per_octave / Constants::per_base;
  const double octaves = std::clamp(std::log2(step), -60.0, 60.0);
  return std::clamp(
      static_cast<int>(std::lround(octaves * per_octave)) * Constants::per_base + Constants::one, 0,
      Constants::most / Constants::per_base * Constants::per_base);
}

StepGrid::StepGrid(const Skeleton& skeleton, const CodingOrder& order, long frames, int levels)
    : levels_(levels), half_((Index{1} << levels) / 2) {
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    const int above = joint.parent < 0 ? -1 : joints_[static_cast<std::size_t>(joint.parent)];
    joints_.push_back(above);
    for (const CodedSlot& slot : order.slots[j]) {
      if (slot.place < 0) continue;
      if (joints_.back() == above) {
        joints_.back() = static_cast<int>(parents_.size());
        parents_.push_back(above);
      }
      groups_.push_back(joints_.back());
      turns_.push_back(is_rotation(joint.channels[static_cast<std::size_t>(slot.slot)]));
    }
  }
  base.assign(groups_.size(), Constants::one);
  offsets.setZero(block(frames - 1) + 1, static_cast<Index>(parents_.size()));
}

void StepGrid::encode(RangeEncoder& encoder) const {
  const auto code_bit = [&](Probability one, bool bit) {
    encoder.encode(bit, one);
    return bit;
  };
  auto steps = base;
  code_base(steps, turns_, code_bit);
  auto finer = offsets;
  code_offsets(finer, parents_, code_bit);
}

bool StepGrid::decode(RangeDecoder& decoder) {
  // Zeros take no time: who has run out is told so below.
  const auto code_bit = [&](Probability one, bool) {
    return !decoder.ran_out() && decoder.decode(one);
  };
  if (!code_base(base, turns_, code_bit)) return false;
  code_offsets(offsets, parents_, code_bit);
  return !decoder.ran_out();
}

}  // namespace reprise
