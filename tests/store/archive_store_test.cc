#include "store/archive_store.h"

#include <sqlite3.h>

#include "store/sample_store.h"

namespace reprise {
namespace {

class ArchiveStoreTest : public StoreTest {};

TEST_F(ArchiveStoreTest, RecordsComeBack) {
  const Ground ground = make_sample(path_, 5);
  const ArchiveStore store = ArchiveStore::open_for_reading(path_);
  for (int i = 0; i < 5; ++i) {
    const TakeRecord put = sample_take(ground, i);
    const auto got = store.find_take(put.info.name);
    ASSERT_TRUE(got);
    EXPECT_EQ(got->info.subject, put.info.subject);
    EXPECT_EQ(got->info.description, put.info.description);
    EXPECT_EQ(got->info.frames, put.info.frames);
    EXPECT_EQ(got->info.frame_rate, 120.0);
    EXPECT_TRUE(got->info.frame_rate_assumed);
    EXPECT_EQ(got->info.error_mm.rms, 22.25);
    EXPECT_EQ(got->info.raw_bytes, 4u * 60u * static_cast<unsigned>(put.info.frames));
    EXPECT_EQ(got->info.source_digest, put.info.source_digest);
    EXPECT_EQ(got->spent, put.spent);
    ASSERT_EQ(got->layers.size(), put.layers.size());
    for (std::size_t layer = 0; layer < put.layers.size(); ++layer) {
      EXPECT_EQ(got->layers[layer].kind, put.layers[layer].kind);
      EXPECT_EQ(got->layers[layer].limit_mm, put.layers[layer].limit_mm);
      EXPECT_EQ(store.layer(got->info.id, layer), put.layers[layer].data);
    }
    const std::int64_t ids[] = {got->info.id};
    const std::vector<ClipRecord> clips = store.clips(ids), put_clips = sample_clips(i);
    ASSERT_EQ(clips.size(), put_clips.size());
    std::uint64_t bytes = 0;
    for (std::size_t c = 0; c < clips.size(); ++c) {
      EXPECT_EQ(clips[c].id, put_clips[c].id);
      EXPECT_EQ(clips[c].take, got->info.id);
      EXPECT_EQ(clips[c].kind, put_clips[c].kind);
      EXPECT_EQ(clips[c].group, put_clips[c].group);
      EXPECT_EQ(clips[c].first_frame, put_clips[c].first_frame);
      EXPECT_EQ(clips[c].frames, put_clips[c].frames);
      EXPECT_EQ(clips[c].primary, put_clips[c].primary);
      bytes += clips[c].bytes;
    }
    EXPECT_EQ(bytes, got->info.payload_bytes);
  }
  EXPECT_EQ(store.space(ground.space).data, random_bytes(300, 9));
  EXPECT_TRUE(store.check_structure().empty());
}

TEST_F(ArchiveStoreTest, LayersAreCompressedWhereThatIsSmaller) {
  ArchiveStore store = ArchiveStore::open_for_writing(path_);
  store.begin();
  const Ground ground = lay_ground(store);
  TakeRecord take = sample_take(ground, 1);
  take.layers[1].data.assign(100'000, 7);
  const std::size_t dense = take.layers[0].data.size();
  store.add_take(take, sample_clips(1));
  store.commit();
  const auto stored = store.find_take(take.info.name);
  ASSERT_TRUE(stored);
  EXPECT_GE(stored->info.payload_bytes, dense);
  EXPECT_LT(stored->info.payload_bytes, dense + 1000);
  EXPECT_EQ(store.layer(stored->info.id, 1), take.layers[1].data);
}

TEST_F(ArchiveStoreTest, NamesAreFoundByTheirEnd) {
  make_sample(path_, 5);
  const ArchiveStore store = ArchiveStore::open_for_reading(path_);
  EXPECT_EQ(store.take_names_ending_in("take_4", 9), std::vector<std::string>{"walks/1/take_4"});
  EXPECT_EQ(store.take_names_ending_in("1/take_4", 9).size(), 1u);
  EXPECT_TRUE(store.take_names_ending_in("2/take_4", 9).empty());
  EXPECT_TRUE(store.take_names_ending_in("ake_4", 9).empty());
}

TEST_F(ArchiveStoreTest, WordsAreFound) {
  make_sample(path_, 5);
  const ArchiveStore store = ArchiveStore::open_for_reading(path_);
  EXPECT_EQ(store.takes({"", "", "person walks", {}}).size(), 2u);
  EXPECT_EQ(store.takes({"", "", "swims", {}}).size(), 0u);
  EXPECT_EQ(store.takes({"", "", "\"odd\" AND (words*", {}}).size(), 0u);
  EXPECT_EQ(store.takes({"", "subject 1", "", {}}).size(), 2u);
}

TEST_F(ArchiveStoreTest, ClipsAreFoundByPrefix) {
  make_sample(path_, 5);
  const ArchiveStore store = ArchiveStore::open_for_reading(path_);
  EXPECT_EQ(store.clips_with_prefix("123456789abcdef0").size(), 1u);
  EXPECT_EQ(store.clips_with_prefix("1234").size(), 1u);
  EXPECT_TRUE(store.clips_with_prefix("0000").empty());
}

TEST_F(ArchiveStoreTest, ContentDoesNotDependOnItsOrder) {
  make_sample(path_, 4);
  ArchiveStore other = ArchiveStore::open_for_writing(folder_ / "other.rpz");
  other.begin();
  const Ground ground = lay_ground(other);
  for (const int i : {3, 1, 7, 0, 2}) add_sample(other, ground, i);
  other.commit();
  const ArchiveStore store = ArchiveStore::open_for_reading(path_);
  EXPECT_NE(other.content_digest(), store.content_digest());
  other.begin();
  other.remove_take(other.find_take(sample_take(ground, 7).info.name)->info.id);
  other.commit();
  EXPECT_EQ(other.content_digest(), store.content_digest());
  EXPECT_TRUE(other.check_structure().empty());
}

TEST_F(ArchiveStoreTest, NothingStaysWhereAllTakesAreRemoved) {
  make_sample(path_, 3);
  ArchiveStore store = ArchiveStore::open_for_writing(path_);
  store.begin();
  for (const TakeInfo& info : store.takes({})) store.remove_take(info.id);
  store.commit();
  EXPECT_TRUE(store.skeletons().empty());
  EXPECT_TRUE(store.subjects().empty());
  EXPECT_TRUE(store.check_structure().empty());
}

TEST_F(ArchiveStoreTest, AddingInManyStepsLeavesNoUnusedPages) {
  {
    ArchiveStore store = ArchiveStore::open_for_writing(path_);
    Ground ground;
    for (int i = 0; i < 12; ++i) {
      store.begin();
      if (i == 0) ground = lay_ground(store);
      add_sample(store, ground, i);
      store.commit();
    }
  }
  const auto size = fs::file_size(path_);
  ArchiveStore::open_for_writing(path_).compact();
  EXPECT_EQ(fs::file_size(path_), size);
}

TEST_F(ArchiveStoreTest, WhatIsHeldStaysForTakesThatCome) {
  const Ground ground = make_sample(path_, 1);
  ArchiveStore store = ArchiveStore::open_for_writing(path_);
  store.hold_proportions(ground.proportions);
  store.begin();
  store.remove_take(store.takes({}).front().id);
  store.commit();
  store.begin();
  add_sample(store, ground, 3);
  store.commit();
  EXPECT_EQ(store.takes({}).size(), 1u);
  EXPECT_TRUE(store.check_structure().empty());
}

TEST_F(ArchiveStoreTest, OneWriterAtATime) {
  make_sample(path_, 1);
  const ArchiveStore writer = ArchiveStore::open_for_writing(path_);
  try {
    ArchiveStore::open_for_writing(path_);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::locked);
  }
}

TEST_F(ArchiveStoreTest, ReadersSeeTheStateBeforeUntilACommit) {
  const Ground ground = make_sample(path_, 2);
  ArchiveStore writer = ArchiveStore::open_for_writing(path_);
  const ArchiveStore reader = ArchiveStore::open_for_reading(path_);
  const std::string before = everything(reader);
  writer.begin();
  add_sample(writer, ground, 5);
  EXPECT_EQ(everything(reader), before);
  writer.commit();
  EXPECT_EQ(reader.takes({}).size(), 3u);
}

TEST_F(ArchiveStoreTest, RolledBackIsAsBefore) {
  const Ground ground = make_sample(path_, 2);
  const std::string before = read_bytes(path_);
  {
    ArchiveStore writer = ArchiveStore::open_for_writing(path_);
    writer.begin();
    add_sample(writer, ground, 5);
    writer.roll_back();
  }
  EXPECT_EQ(read_bytes(path_), before);
}

TEST_F(ArchiveStoreTest, WriterThatStoresNothingLeavesNoFile) {
  { const ArchiveStore store = ArchiveStore::open_for_writing(path_); }
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(ArchiveStoreTest, ReadingWritesNothing) {
  make_sample(path_, 3);
  const std::string before = read_bytes(path_);
  fs::permissions(path_, fs::perms::owner_read);
  everything(ArchiveStore::open_for_reading(path_));
  EXPECT_TRUE(ArchiveStore::open_for_reading(path_).check_structure().empty());
  EXPECT_EQ(read_bytes(path_), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(ArchiveStoreTest, CompactingKeepsEverything) {
  make_sample(path_, 30);
  ArchiveStore store = ArchiveStore::open_for_writing(path_);
  store.begin();
  for (int i = 3; i < 30; ++i) {
    store.remove_take(store.find_take(sample_take({}, i).info.name)->info.id);
  }
  store.commit();
  const std::string before = everything(store);
  const auto size = fs::file_size(path_);
  store.compact();
  EXPECT_LT(fs::file_size(path_), size);
  EXPECT_EQ(everything(store), before);
  EXPECT_TRUE(store.check_structure().empty());
}

TEST_F(ArchiveStoreTest, StatisticsAddUp) {
  make_sample(path_, 6);
  const ArchiveStore store = ArchiveStore::open_for_reading(path_);
  std::uint64_t weights = 0;
  const ArchiveStats stats =
      store.stats([&](const TakeRecord&, std::uint64_t weight) { weights += weight; });
  std::uint64_t sum = 0;
  for (const auto& [name, bytes] : stats.bytes) sum += bytes;
  EXPECT_EQ(sum, stats.archive_bytes);
  EXPECT_EQ(stats.archive_bytes, fs::file_size(path_));
  EXPECT_EQ(stats.takes, 6u);
  EXPECT_EQ(weights, stats.frames * 20);
}

TEST_F(StoreTest, SpacesAreReadOnceHoweverManyExtendEachOther) {
  // Each that asked twice for the one before it would take twice as long as that one.
  ArchiveStore store = ArchiveStore::open_for_writing(path_);
  store.begin();
  const Ground ground = lay_ground(store);
  std::int64_t last = ground.space;
  for (unsigned i = 0; i < 60; ++i)
    last = store.add_space({0, ground.skeleton, last, random_bytes(20, i)});
  const SpaceChain chain = store.space_chain(last);
  ASSERT_EQ(chain.spaces.size(), 61u);
  EXPECT_EQ(chain.spaces.front().id, ground.space);
  EXPECT_EQ(chain.spaces.back().data, random_bytes(20, 59));
  EXPECT_EQ(chain.digest, store.digest_of_space(last));
  EXPECT_NE(chain.digest, store.digest_of_space(chain.spaces[59].id));
}

TEST_F(StoreTest, SpacesExtendThoseOfTheirOwnSkeleton) {
  ArchiveStore store = ArchiveStore::open_for_writing(path_);
  store.begin();
  const Ground ground = lay_ground(store), other = lay_ground(store);
  const std::int64_t mixed = store.add_space({0, other.skeleton, ground.space, {1, 2, 3}});
  try {
    store.space(mixed);
    ADD_FAILURE() << "a space of two skeletons";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::damaged);
  }
}

TEST_F(StoreTest, WordsWithControlCharactersAreLookedForToo) {
  make_sample(path_, 6);
  const ArchiveStore store = ArchiveStore::open_for_reading(path_);
  TakeFilter filter;
  for (const std::string& text : {std::string("walks\0person", 12), std::string("walks\nperson")}) {
    filter.text = text;
    EXPECT_EQ(store.takes(filter).size(), 3u);
  }
}

TEST_F(StoreTest, TakesHaveAFrameRate) {
  for (const double rate : {0.0, -120.0, 1e300}) {
    fs::remove(path_);
    ArchiveStore store = ArchiveStore::open_for_writing(path_);
    store.begin();
    Ground ground = lay_ground(store);
    ProportionsRecord proportions = store.proportions(ground.proportions);
    proportions.frame_rate = rate;
    ground.proportions = store.add_proportions(proportions);
    try {
      add_sample(store, ground, 0);
      ADD_FAILURE() << rate;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::damaged) << rate;
    }
  }
}

TEST_F(StoreTest, TakesHaveAnUpAxis) {
  ArchiveStore store = ArchiveStore::open_for_writing(path_);
  store.begin();
  Ground ground = lay_ground(store);
  ProportionsRecord proportions = store.proportions(ground.proportions);
  proportions.up = UpAxis::minus_z;
  ground.proportions = store.add_proportions(proportions);
  EXPECT_EQ(store.proportions(ground.proportions).up, UpAxis::minus_z);
  EXPECT_NO_THROW(add_sample(store, ground, 0));
  proportions.up = static_cast<UpAxis>(6);
  ground.proportions = store.add_proportions(proportions);
  try {
    store.proportions(ground.proportions);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::damaged);
  }
}

TEST_F(StoreTest, WhatIsAssumedIsKeptApart) {
  ArchiveStore store = ArchiveStore::open_for_writing(path_);
  store.begin();
  const Ground ground = lay_ground(store);
  for (int bits = 0; bits < 8; ++bits) {
    ProportionsRecord proportions = store.proportions(ground.proportions);
    proportions.asf_name = "set" + std::to_string(bits);
    proportions.frame_rate_assumed = (bits & 1) != 0;
    proportions.unit_assumed = (bits & 2) != 0;
    proportions.up_assumed = (bits & 4) != 0;
    const ProportionsRecord back = store.proportions(store.add_proportions(proportions));
    EXPECT_EQ(back.frame_rate_assumed, proportions.frame_rate_assumed) << bits;
    EXPECT_EQ(back.unit_assumed, proportions.unit_assumed) << bits;
    EXPECT_EQ(back.up_assumed, proportions.up_assumed) << bits;
  }
}

}  // namespace
}  // namespace reprise
