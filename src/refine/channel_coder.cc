#include "refine/channel_coder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>

#include "quant/catmull_rom.h"

namespace reprise {
namespace {

using Eigen::Index;

/// Sizes of the context tables; all constants here belong to the archive format.
constexpr std::uint32_t level_slots = 14;
constexpr std::uint32_t bins = 24;  ///< of an expected magnitude
constexpr std::uint32_t few_bins = 8;
constexpr std::uint32_t last_bucket = 59;  ///< of numbers up to 2^29
/// Is it beyond bucket 0, 1, ..; those from here on share their counters.
constexpr std::uint32_t decisions = 31;
constexpr std::uint32_t sign_decision = decisions, mantissa_decisions = decisions + 1;
constexpr std::uint32_t kinds = decisions + 1 + 2 * decisions;
constexpr std::array<std::uint32_t, BitModelConstants::inputs> context_counts = {
    bins * level_slots, bins* few_bins, bins* few_bins, few_bins* few_bins* few_bins, 4096};

/// Buckets 0, 1, 2, 3, 4-5, 6-7, 8-11, 12-15, ..: the first number of each, and its bits.
struct Bucket {
  std::int32_t first;
  int bits;
};
constexpr Bucket bucket(std::uint32_t index) {
  if (index < 4) return {static_cast<std::int32_t>(index), 0};
  const int bits = static_cast<int>(index - 2) / 2;
  return {static_cast<std::int32_t>((2u + (index & 1u)) << bits), bits};
}
constexpr std::uint32_t bucket_of(std::int32_t magnitude) {
  if (magnitude < 4) return static_cast<std::uint32_t>(magnitude);
  const int width = std::bit_width(static_cast<std::uint32_t>(magnitude));
  return static_cast<std::uint32_t>(2 * (width - 2) + 2 + ((magnitude >> (width - 2)) & 1));
}
static_assert(bucket_of(bucket(17).first) == 17 && bucket_of(4) == 4 && bucket_of(6) == 5 &&
              bucket_of(8) == 6);

/// Logarithmic bins of sums that count in sixteenths.
std::uint32_t bin(std::int64_t sum, std::uint32_t count, int per_octave) {
  if (sum <= 0) return 0;
  const auto value = static_cast<std::uint64_t>(sum);
  const auto width = static_cast<int>(std::bit_width(value));
  std::uint32_t result = static_cast<std::uint32_t>(width) * static_cast<std::uint32_t>(per_octave);
  if (per_octave == 2 && width > 1) result += (value >> (width - 2)) & 1;
  return std::min(result, count - 1);
}

template <class Io>
class Walk {
 public:
  Walk(Io io, const ChannelKnotShape& shape, ChannelKnots& knots, Index channel)
      : io_(io), shape_(shape), knots_(knots), channel_(channel) {}

  void run() {
    const Index stride = Index{1} << shape_.levels;
    std::int32_t before = 0;
    for (Index f = 0; f < shape_.frames; f += stride)
      before = code(f, stride, shape_.levels, before);
    for (int level = shape_.levels - 1; level >= 0; --level) {
      const Index apart = Index{1} << level;
      for (Index f = apart; f < shape_.frames; f += 2 * apart) code(f, apart, level, 0);
    }
  }

 private:
  std::int64_t magnitude(Index frame, Index channel) const {
    if (frame < 0 || frame >= shape_.frames || channel < 0) return 0;
    return std::min<std::int64_t>(std::abs(static_cast<std::int64_t>(knots_(frame, channel))),
                                  most_knot);
  }

  std::int32_t code(Index f, Index apart, int level, std::int32_t predicted) {
    const bool coarsest = level == shape_.levels;
    const Index step = coarsest ? apart : 2 * apart;
    const std::uint32_t slot =
        coarsest ? level_slots - 1
                 : std::min<std::uint32_t>(level_slots - 2,
                                           static_cast<std::uint32_t>(level + shape_.first_level));
    const std::int64_t a = coarsest ? last_ : magnitude(f - step, channel_);
    const std::int64_t a2 = coarsest ? last2_ : magnitude(f - 2 * step, channel_);
    const std::int64_t up = coarsest ? 0
                            : level + 1 == shape_.levels
                                ? 0
                                : magnitude(f - apart, channel_) + magnitude(f + apart, channel_);
    const Index parent = shape_.parents[static_cast<std::size_t>(channel_)];
    const auto around = [&](Index c) {
      return coarsest ? 0 : 2 * magnitude(f, c) + magnitude(f - step, c) + magnitude(f + step, c);
    };
    const std::int64_t beside = around(channel_ - 1), chain = around(parent),
                       beside2 = around(channel_ - 2);
    const std::int64_t own = 8 * a + 4 * a2 + 2 * up;
    const std::uint32_t mixed = bin(2 * own + beside + chain + beside2 / 2, bins, 2);
    base_[0] = mixed * level_slots + slot;
    base_[1] = bin(own, bins, 2) * few_bins + bin(beside + chain, few_bins, 1);
    base_[2] = bin(beside * 2 + chain * 2 + beside2, bins, 2) * few_bins + bin(a, few_bins, 1);
    base_[3] =
        (bin(up, few_bins, 1) * few_bins + bin(a, few_bins, 1)) * few_bins + bin(a2, few_bins, 1);
    base_[4] =
        std::min<std::uint32_t>(static_cast<std::uint32_t>(channel_), 255) * level_slots + slot;
    base_[4] %= 4096;
    weights_ = slot;
    const std::int32_t value = static_cast<std::int32_t>(
        static_cast<std::uint32_t>(knots_(f, channel_)) - static_cast<std::uint32_t>(predicted));
    const std::int32_t coded = code_value(value);
    if (coarsest) {
      last2_ = last_;
      last_ = std::min<std::int64_t>(std::abs(static_cast<std::int64_t>(coded)), most_knot);
    }
    knots_(f, channel_) = static_cast<std::int32_t>(static_cast<std::uint32_t>(predicted) +
                                                    static_cast<std::uint32_t>(coded));
    return knots_(f, channel_);
  }

  bool decide(std::uint32_t kind, bool bit) {
    BitMixer::Contexts contexts;
    for (std::size_t t = 0; t < BitModelConstants::inputs; ++t) {
      contexts.counter[t] = kind * context_counts[t] + base_[t];
    }
    contexts.weights = kind * level_slots + weights_;
    return io_(contexts, bit);
  }

  std::int32_t code_value(std::int32_t value) {
    const std::int32_t size = std::abs(value);
    const std::uint32_t goal = bucket_of(size);
    std::uint32_t index = 0;
    while (index < last_bucket && decide(std::min(index, decisions - 1), goal > index)) ++index;
    if (index == 0) return 0;
    const Bucket in = bucket(index);
    std::int32_t rest = size - in.first;
    std::int32_t known = 0;
    int left = in.bits;
    for (int modelled = 0; modelled < 2 && left > 0; ++modelled) {
      --left;
      const bool bit = decide(mantissa_decisions + 2 * std::min(index, decisions - 1) +
                                  static_cast<std::uint32_t>(modelled),
                              (rest >> left & 1) != 0);
      known = known << 1 | static_cast<std::int32_t>(bit);
    }
    known = known << left |
            static_cast<std::int32_t>(io_.plain(static_cast<std::uint32_t>(rest), left));
    const std::int32_t result = in.first + known;
    return decide(sign_decision, value < 0) ? -result : result;
  }

  Io io_;
  const ChannelKnotShape& shape_;
  ChannelKnots& knots_;
  Index channel_;
  std::array<std::uint32_t, BitModelConstants::inputs> base_{};
  std::uint32_t weights_ = 0;
  std::int64_t last_ = 0, last2_ = 0;
};

struct Writer {
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

struct Reader {
  RangeDecoder& decoder;
  BitMixer& mixer;
  bool operator()(const BitMixer::Contexts& contexts, bool) {
    return mixer.decode(decoder, contexts);
  }
  std::uint32_t plain(std::uint32_t, int count) { return decoder.decode_plain(count); }
};

std::array<std::size_t, BitModelConstants::inputs> table_sizes() {
  std::array<std::size_t, BitModelConstants::inputs> sizes;
  for (std::size_t t = 0; t < sizes.size(); ++t) sizes[t] = std::size_t{kinds} * context_counts[t];
  return sizes;
}

}  // namespace

ChannelCoder::ChannelCoder() : mixer_(table_sizes(), std::size_t{kinds} * level_slots) {}

void ChannelCoder::encode(RangeEncoder& encoder, const ChannelKnotShape& shape,
                          ChannelKnots knots) {
  for (Index c = 0; c < knots.cols(); ++c) Walk<Writer>({encoder, mixer_}, shape, knots, c).run();
}

ChannelKnots ChannelCoder::decode(RangeDecoder& decoder, const ChannelKnotShape& shape) {
  ChannelKnots knots = ChannelKnots::Zero(shape.frames, static_cast<Index>(shape.parents.size()));
  for (Index c = 0; c < knots.cols(); ++c) Walk<Reader>({decoder, mixer_}, shape, knots, c).run();
  return knots;
}

}  // namespace reprise
