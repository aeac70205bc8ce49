#include "refine/channel_coder.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "quant/coded_bits.h"
#include "quant/magnitude_bins.h"
#include "refine/channel_contexts.h"
#include "refine/knot_sizes.h"

namespace reprise {
namespace {

using Eigen::Index;

constexpr int activity_decay = 3;  ///< an eighth a channel; belongs to the archive format

template <class Io>
class Walk : ChannelContexts {
 public:
  Walk(Io io, const ChannelKnotShape& shape, const StepGrid& steps, ChannelKnots& knots)
      : io_(io),
        shape_(shape),
        steps_(steps),
        knots_(knots),
        sizes_(knots.rows(), knots.cols(), shape.levels),
        activities_(knots.rows(), 1, shape.levels) {}

  void run() {
    for (channel_ = 0; channel_ < knots_.cols(); ++channel_) {
      if (steps_.base[static_cast<std::size_t>(channel_)] < 0) continue;
      own_ = sizes_.column(channel_);
      beside_ = sizes_.column(channel_ - 1);
      beside_that_ = sizes_.column(channel_ - 2);
      // The first channels of a skeleton hang on none.
      chain_ = sizes_.column(std::max(-1, shape_.parents[static_cast<std::size_t>(channel_)]));
      const Index stride = Index{1} << shape_.levels;
      for (Index f = 0; f < shape_.frames; f += stride) code(f, stride, shape_.levels);
      for (int level = shape_.levels - 1; level >= 0; --level) {
        const Index apart = Index{1} << level;
        for (Index f = apart; f < shape_.frames; f += 2 * apart) code(f, apart, level);
      }
    }
  }

 private:
  /// 0 negative, 1 zero or not there, 2 positive.
  std::uint32_t sign(Index frame, Index channel) const {
    if (frame < 0 || frame >= shape_.frames || channel < 0) return 1;
    const std::int32_t value = knots_(frame, channel);
    return value < 0 ? 0 : value > 0 ? 2 : 1;
  }

  /// Where a knot stands: those of the coarser levels are `apart` from it on both sides, or nowhere
  /// (0); those of its own level `step`.
  struct Place {
    Index frame, step, apart;
    std::uint32_t slot;
  };

  void code(Index f, Index apart, int level) {
    if constexpr (requires { io_.ran_out(); }) {
      if (io_.ran_out()) return;
    }
    const bool coarsest = level == shape_.levels;
    const Place place = {
        f, coarsest ? apart : 2 * apart, coarsest ? 0 : apart,
        coarsest ? level_slots - 1
                 : std::min<std::uint32_t>(level_slots - 2,
                                           static_cast<std::uint32_t>(level + shape_.first_level))};
    const int offset = steps_.offset(static_cast<std::size_t>(channel_), f);
    size_contexts_ = expected_size(place, offset);
    knots_(f, channel_) = code_value(place, knots_(f, channel_));
    const auto magnitude = static_cast<std::uint64_t>(
        std::min<std::int64_t>(std::abs(std::int64_t{knots_(f, channel_)}), most_size));
    own_[f] = in_finer_steps(magnitude << size_bits, -offset);
    activity_[f] += own_[f];
    activity_[f] -= activity_[f] >> activity_decay;
  }

  using Contexts = std::array<std::uint32_t, BitModelConstants::inputs>;

  Contexts expected_size(const Place& place, int offset) const {
    const auto [f, step, apart, slot] = place;
    const auto in_bins = [&](std::uint64_t sum, std::uint32_t of, int per_octave) {
      return size_bin(in_finer_steps(sum, offset) >> size_bits, of, per_octave);
    };
    const auto around = [&place](const std::uint64_t* sizes) {  // clang 14: not the binding
      return 2 * sizes[place.frame] + sizes[place.frame - place.step] +
             sizes[place.frame + place.step];
    };
    const std::uint64_t before = own_[f - step];
    const std::uint64_t coarser = apart > 0 ? own_[f - apart] + own_[f + apart] : 0;
    const std::uint64_t own = 8 * before + 4 * own_[f - 2 * step] + 2 * coarser;
    const std::uint64_t beside = around(beside_), chain = around(chain_);
    const std::uint64_t active = around(activity_);
    const std::uint32_t before_bin = in_bins(before, few_bins, 1);
    return {in_bins(2 * own + beside + chain + active / 4, bins, 2) * level_slots + slot,
            in_bins(own, bins, 2) * few_bins + in_bins(beside + chain, few_bins, 1),
            in_bins(2 * beside + 2 * chain + around(beside_that_), bins, 2) * few_bins + before_bin,
            (in_bins(active, bins, 2) * few_bins + before_bin) * few_bins +
                in_bins(coarser, few_bins, 1),
            std::min(static_cast<std::uint32_t>(channel_), most_channel) * level_slots + slot};
  }

  Contexts expected_sign(const Place& place) const {
    const auto [f, step, apart, slot] = place;
    const std::uint32_t before = sign(f - step, channel_), beside = sign(f, channel_ - 1);
    const std::uint32_t chain = sign(f, shape_.parents[static_cast<std::size_t>(channel_)]);
    const std::uint32_t left = apart > 0 ? sign(f - apart, channel_) : 1;
    const std::uint32_t right = apart > 0 ? sign(f + apart, channel_) : 1;
    return {
        before * level_slots + slot, (left * 3 + right) * 3 + before,
        (chain * 3 + beside) * 3 + sign(f, channel_ - 2), sign(f - 2 * step, channel_) * 3 + before,
        (std::min(static_cast<std::uint32_t>(channel_), most_channel) * 3 + chain) * 3 + beside};
  }

  bool decide(std::uint32_t kind, const Contexts& expected, bool bit) {
    BitMixer::Contexts contexts;
    for (std::size_t t = 0; t < BitModelConstants::inputs; ++t) {
      contexts.counter[t] = kind * count[t] + expected[t];
    }
    contexts.weights = kind;
    return io_(contexts, bit);
  }

  std::int32_t code_value(const Place& place, std::int32_t value) {
    const auto magnitude = static_cast<std::uint32_t>(std::abs(value));
    const std::uint32_t goal = bucket_of(magnitude);
    std::uint32_t index = 0;
    while (index < last_bucket &&
           decide(std::min(index, decisions - 1), size_contexts_, goal > index)) {
      ++index;
    }
    if (index == 0) return 0;
    const Bucket in = bucket(index);
    const std::uint32_t rest = magnitude - in.first;
    std::uint32_t known = 0;
    int left = in.bits;
    for (std::uint32_t modelled = 0; modelled < 2 && left > 0; ++modelled) {
      --left;
      const std::uint32_t kind = mantissa_decisions + 2 * std::min(index, decisions - 1) + modelled;
      known = known << 1 | decide(kind, size_contexts_, (rest >> left & 1) != 0);
    }
    known = known << left | io_.plain(rest, left);
    const auto result = static_cast<std::int32_t>(in.first + known);
    return decide(sign_decision, expected_sign(place), value < 0) ? -result : result;
  }

  Io io_;
  const ChannelKnotShape& shape_;
  const StepGrid& steps_;
  ChannelKnots& knots_;
  KnotSizes sizes_;
  /// In one column, of each frame: sizes of the channels before, the nearest ones most.
  KnotSizes activities_;
  std::uint64_t* activity_ = activities_.column(0);
  Index channel_ = 0;
  /// Sizes of the channel, of the two before it, and of the one that it hangs on.
  std::uint64_t* own_ = nullptr;
  const std::uint64_t *beside_ = nullptr, *beside_that_ = nullptr, *chain_ = nullptr;
  Contexts size_contexts_{};
};

}  // namespace

ChannelCoder::ChannelCoder() : mixer_(fresh_channel_mixer()) {}

void ChannelCoder::encode(RangeEncoder& encoder, const ChannelKnotShape& shape,
                          const StepGrid& steps, ChannelKnots knots) {
  Walk<BitWriter>({encoder, mixer_}, shape, steps, knots).run();
}

ChannelKnots ChannelCoder::decode(RangeDecoder& decoder, const ChannelKnotShape& shape,
                                  const StepGrid& steps) {
  ChannelKnots knots = ChannelKnots::Zero(shape.frames, static_cast<Index>(shape.parents.size()));
  Walk<BitReader>({decoder, mixer_}, shape, steps, knots).run();
  return knots;
}

double ChannelCoder::learn(const ChannelKnotShape& shape, const StepGrid& steps,
                           ChannelKnots knots) {
  std::uint64_t cost = 0;
  Walk<BitLearner>({cost, mixer_}, shape, steps, knots).run();
  return static_cast<double>(cost) / 65536;
}

}  // namespace reprise
