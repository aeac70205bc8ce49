#include "quant/range_coder.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "quant/bit_model.h"
#include "quant/numbers.h"

namespace reprise {
namespace {

TEST(RangeCoder, BitsOfAnyProbabilityComeBack) {
  std::mt19937 random(1);
  for (const std::size_t count : {0u, 1u, 2u, 7u, 100u, 20000u}) {
    std::vector<std::pair<bool, Probability>> bits;
    RangeEncoder encoder;
    for (std::size_t i = 0; i < count; ++i) {
      const Probability one = 1 + random() % 65535;
      bits.emplace_back(random() % 65536 < one, one);
      encoder.encode(bits.back().first, one);
    }
    const auto bytes = encoder.finish();
    RangeDecoder decoder(bytes);
    for (const auto& [bit, one] : bits) ASSERT_EQ(decoder.decode(one), bit);
  }
}

TEST(RangeCoder, UnlikelyBitsComeBackToo) {
  RangeEncoder encoder;
  for (int i = 0; i < 1000; ++i) encoder.encode(i % 2 == 0, i % 2 == 0 ? 1 : 65535);
  const auto bytes = encoder.finish();
  RangeDecoder decoder(bytes);
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(decoder.decode(i % 2 == 0 ? 1 : 65535), i % 2 == 0);
}

TEST(RangeCoder, LikelyBitsCostLittle) {
  RangeEncoder encoder;
  for (int i = 0; i < 100000; ++i) encoder.encode(false, 64);
  EXPECT_LT(encoder.finish().size(), 40u);
}

TEST(RangeCoder, EndlessStreamsAreCounted) {
  RangeDecoder decoder({});
  for (int i = 0; i < 800; ++i) decoder.decode_plain(1);
  EXPECT_GT(decoder.bytes_past_end(), 90u);
}

TEST(Numbers, ExtremesComeBack) {
  const std::uint32_t numbers[] = {0, 1, 2, 3, 254, 65535, 1u << 31, 0xffffffff};
  const std::int32_t signed_numbers[] = {0,
                                         -1,
                                         1,
                                         -77,
                                         77,
                                         std::numeric_limits<std::int32_t>::max(),
                                         std::numeric_limits<std::int32_t>::min() + 1};
  RangeEncoder encoder;
  for (const auto number : numbers) encode_number(encoder, number);
  for (const auto number : signed_numbers) encode_signed(encoder, number);
  const auto bytes = encoder.finish();
  RangeDecoder decoder(bytes);
  for (const auto number : numbers) EXPECT_EQ(decode_number(decoder), number);
  for (const auto number : signed_numbers) EXPECT_EQ(decode_signed(decoder), number);
}

class BitMixerTest : public testing::Test {
 protected:
  static constexpr std::size_t sizes[BitModelConstants::inputs] = {4, 8, 2, 16, 3};

  BitMixer::Contexts random_contexts() {
    BitMixer::Contexts contexts;
    for (std::size_t t = 0; t < contexts.counter.size(); ++t) {
      contexts.counter[t] = static_cast<std::uint32_t>(random_() % sizes[t]);
    }
    contexts.weights = random_() % 2;
    return contexts;
  }
  /// Mostly what one of the first two contexts says.
  bool likely_bit(const BitMixer::Contexts& contexts) {
    return random_() % 10 == 0 ? random_() % 2 : contexts.counter[random_() % 4 == 0] % 2;
  }

  std::mt19937 random_{2};
};

TEST_F(BitMixerTest, DecoderLearnsWhatTheEncoderLearns) {
  BitMixer writer(sizes, 2), reader(sizes, 2);
  RangeEncoder encoder;
  std::vector<std::pair<BitMixer::Contexts, bool>> coded;
  for (int i = 0; i < 5000; ++i) {
    const auto contexts = random_contexts();
    coded.emplace_back(contexts, likely_bit(contexts));
    writer.encode(encoder, contexts, coded.back().second);
  }
  const auto bytes = encoder.finish();
  RangeDecoder decoder(bytes);
  for (const auto& [contexts, bit] : coded) ASSERT_EQ(reader.decode(decoder, contexts), bit);
}

TEST_F(BitMixerTest, CostIsWhatCodingTakes) {
  BitMixer writer(sizes, 2), learner(sizes, 2);
  RangeEncoder encoder;
  double cost = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto contexts = random_contexts();
    const bool bit = likely_bit(contexts);
    writer.encode(encoder, contexts, bit);
    cost += learner.learn(contexts, bit) / 65536.0;
  }
  const double bits = 8.0 * static_cast<double>(encoder.finish().size());
  EXPECT_NEAR(cost / bits, 1.0, 0.01);
}

TEST_F(BitMixerTest, AByteHoldsOnlySoManyDecisions) {
  constexpr std::size_t decisions = 1'000'000;
  BitMixer writer(sizes, 2);
  RangeEncoder encoder;
  for (std::size_t i = 0; i < decisions; ++i) writer.encode(encoder, {}, false);
  const std::size_t bytes = encoder.finish().size();
  EXPECT_GT(bytes * most_decisions_per_byte, decisions);
  EXPECT_LT(bytes * most_decisions_per_byte, 2 * decisions) << "what is promised is far off";
}

TEST_F(BitMixerTest, PriorIsTheSameForWhoSavesAndWhoLoads) {
  BitMixer learned(sizes, 2);
  for (int i = 0; i < 3000; ++i) {
    const auto contexts = random_contexts();
    learned.learn(contexts, likely_bit(contexts));
  }
  RangeEncoder saved;
  learned.save(saved, BitMixer(sizes, 2));
  const auto bytes = saved.finish();
  BitMixer first(sizes, 2), second(sizes, 2), fresh(sizes, 2);
  RangeDecoder one(bytes), two(bytes);
  first.load(one);
  second.load(two);
  double with = 0, without = 0;
  for (int i = 0; i < 300; ++i) {
    const auto contexts = random_contexts();
    const bool bit = likely_bit(contexts);
    const auto cost = first.learn(contexts, bit);
    ASSERT_EQ(cost, second.learn(contexts, bit));
    with += cost;
    without += fresh.learn(contexts, bit);
  }
  EXPECT_LT(with, 0.98 * without);
}

}  // namespace
}  // namespace reprise
