// Columns of numbers and blocks of takes come back, and nothing that is none crashes.
#include "store/take_block.h"

#include <limits>
#include <span>

#include "store/number_columns.h"
#include "store/sample_store.h"

namespace reprise {
namespace {

TEST(NumberColumns, NumbersComeBack) {
  std::mt19937_64 random(1);
  for (const int shift : {0, 1, 7, 31, 56, 63}) {
    for (const std::size_t count : {0u, 1u, 2u, 63u, 300u}) {
      std::vector<std::uint64_t> values(count);
      for (auto& value : values) value = random() >> shift;
      ColumnWriter writer;
      writer.numbers(values);
      writer.number(values.empty() ? 5 : values[0]);
      const Bytes bytes = writer.finish();
      ColumnReader reader(bytes);
      EXPECT_EQ(reader.numbers(count), values);
      EXPECT_EQ(reader.number(), values.empty() ? 5 : values[0]);
      EXPECT_TRUE(reader.rest().empty());
    }
  }
}

TEST(NumberColumns, EqualNumbersTakeNoBits) {
  ColumnWriter writer;
  writer.numbers(std::vector<std::uint64_t>(1000, 77));
  EXPECT_EQ(writer.finish().size(), 2u);
}

TEST(NumberColumns, SignedNumbersComeBack) {
  for (const std::int64_t value :
       {std::int64_t{0}, std::int64_t{-1}, std::int64_t{1},
        std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
    EXPECT_EQ(unfolded(folded(value)), value);
  }
}

TEST(NumberColumns, WhatEndsTooEarlyIsAnError) {
  ColumnWriter writer;
  writer.numbers(std::vector<std::uint64_t>{1, 1000, 5});
  const Bytes bytes = writer.finish();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ColumnReader reader(std::span<const std::uint8_t>(bytes).first(size));
    EXPECT_THROW(reader.numbers(3), Error);
  }
}

TakeBlock sample_block(int takes, std::size_t gap) {
  TakeBlock block{3, {}};
  for (int i = 0; i < takes; ++i) {
    StoredTake take;
    take.slot = static_cast<std::size_t>(i) * gap + gap - 1;
    take.record = sample_take({1, 2, 3}, i);
    for (LayerRecord& layer : take.record.layers) {
      take.places.push_back({block.data_size(), layer.data.size(), i % 2 == 0, {}});
      take.places.back().digest = shortened(digest_of(layer.data));
      layer.data.clear();
    }
    take.record.info.id = block.id_of(take);
    for (int c = 0; c < i % 4; ++c) {
      StoredClip clip{sample_clip(i + 100 * c).id, ClipKind::unique, i % 3, 10 + c, {}};
      if (c == i % 3) {
        clip.kind = ClipKind::repeated;
        clip.primary = {i % 2 == 0 ? 1 : std::int64_t{1} << 40, static_cast<std::size_t>(i)};
      }
      take.clips.push_back(clip);
    }
    if (!take.clips.empty()) {
      take.clips.back().frames = take.record.info.frames;
      for (std::size_t c = 0; c + 1 < take.clips.size(); ++c)
        take.clips.back().frames -= take.clips[c].frames;
    }
    block.takes.push_back(std::move(take));
  }
  return block;
}

TEST(TakeBlock, TakesComeBack) {
  for (const std::size_t gap : {1u, 2u, 5u}) {
    const TakeBlock put = sample_block(static_cast<int>(64 / gap), gap);
    const TakeBlock got = unpack_block(put.id, pack_block(put));
    ASSERT_EQ(got.takes.size(), put.takes.size());
    for (std::size_t i = 0; i < put.takes.size(); ++i) {
      const StoredTake &a = got.takes[i], &b = put.takes[i];
      EXPECT_EQ(a.slot, b.slot);
      EXPECT_EQ(a.record.info.name, b.record.info.name);
      EXPECT_EQ(a.record.info.subject, b.record.info.subject);
      EXPECT_EQ(a.record.info.description, b.record.info.description);
      EXPECT_EQ(a.record.info.text_bytes, b.record.info.text_bytes);
      EXPECT_EQ(a.record.info.error_mm.max, b.record.info.error_mm.max);
      EXPECT_EQ(a.record.info.fidelity, b.record.info.fidelity);
      EXPECT_EQ(a.record.info.rotation_deg.p99, b.record.info.rotation_deg.p99);
      EXPECT_EQ(a.record.info.worst_place, b.record.info.worst_place);
      EXPECT_EQ(a.record.info.worst_turn, b.record.info.worst_turn);
      EXPECT_EQ(a.record.turn_quantiles, b.record.turn_quantiles);
      EXPECT_EQ(a.record.error_quantiles, b.record.error_quantiles);
      EXPECT_EQ(a.record.spent, b.record.spent);
      EXPECT_EQ(a.clips, b.clips);
      ASSERT_EQ(a.places.size(), b.places.size());
      for (std::size_t layer = 0; layer < a.places.size(); ++layer) {
        EXPECT_EQ(a.places[layer].digest, b.places[layer].digest);
        EXPECT_EQ(a.places[layer].size, b.places[layer].size);
        EXPECT_EQ(a.places[layer].compressed, b.places[layer].compressed);
      }
    }
  }
}

TEST(TakeBlock, ErrorsTooLargeToComeBackAreAnError) {
  // Packed again when a take is added beside it, such a take would get another error.
  TakeBlock block = sample_block(2, 1);
  block.takes[1].record.info.error_mm.max = 4.5e12;
  EXPECT_THROW(unpack_block(block.id, pack_block(block)), Error);
  block = sample_block(2, 1);
  block.takes[0].record.layers[0].limit_mm = 4.5e12;
  EXPECT_THROW(unpack_block(block.id, pack_block(block)), Error);
}

TEST(TakeBlock, OtherBytesAreAnErrorOrABlock) {
  const Bytes good = pack_block(sample_block(20, 2));
  std::mt19937 random(3);
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_THROW(unpack_block(1, std::span<const std::uint8_t>(good).first(size)), Error) << size;
  for (int trial = 0; trial < 3000; ++trial) {
    Bytes bad = good;
    for (unsigned flips = 0; flips <= random() % 3; ++flips)
      bad[random() % bad.size()] = static_cast<std::uint8_t>(random());
    try {
      pack_block(unpack_block(1, bad));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::damaged);
    }
  }
}

}  // namespace
}  // namespace reprise
