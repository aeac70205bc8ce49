// Takes and clips are found without reading the others, and stay findable through changes.
#include <sqlite3.h>

#include <map>

#include "store/sample_store.h"

namespace reprise {
namespace {

/// Rows that statements went through without an index, on all connections opened while it lives.
class FullScans {
 public:
  FullScans() {
    steps_ = 0;
    sqlite3_auto_extension(reinterpret_cast<void (*)()>(&watch));
  }
  ~FullScans() { sqlite3_cancel_auto_extension(reinterpret_cast<void (*)()>(&watch)); }
  static void forget() { steps_ = 0; }
  static int steps() { return steps_; }

 private:
  static int watch(sqlite3* database, char**, const void*) {
    return sqlite3_trace_v2(database, SQLITE_TRACE_PROFILE, &note, nullptr);
  }
  static int note(unsigned, void*, void* statement, void*) {
    steps_ += sqlite3_stmt_status(static_cast<sqlite3_stmt*>(statement),
                                  SQLITE_STMTSTATUS_FULLSCAN_STEP, 0);
    return 0;
  }
  static inline int steps_ = 0;
};

class Lookup : public StoreTest {};

TEST_F(Lookup, LookupsGoThroughTheIndex) {
  const FullScans scans;
  const Ground ground = make_sample(path_, 300);
  const ArchiveStore store = ArchiveStore::open_for_reading(path_);
  store.takes({});
  EXPECT_GT(FullScans::steps(), 0);
  for (const int i : {0, 1, 150, 299}) {
    FullScans::forget();
    const std::string name = sample_take(ground, i).info.name;
    const auto take = store.find_take(name);
    ASSERT_TRUE(take);
    EXPECT_EQ(store.take(take->info.id).info.name, name);
    EXPECT_EQ(store.take_names_ending_in("take_" + std::to_string(i), 5).size(), 1u);
    EXPECT_EQ(store.takes({"take_" + std::to_string(i), "", "", {}}).size(), 1u);
    EXPECT_EQ(store.layer(take->info.id, 0), sample_take(ground, i).layers[0].data);
    for (const ClipRecord& clip : sample_clips(i)) {
      char digits[17];
      std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(clip.id));
      for (const std::size_t length : {4u, 9u, 16u}) {
        const auto found = store.clips_with_prefix(std::string(digits, length));
        EXPECT_TRUE(std::ranges::any_of(found, [&](const ClipRecord& other) {
          return other.id == clip.id && other.take == take->info.id;
        })) << digits;
      }
    }
    EXPECT_FALSE(store.find_take("no such take"));
    EXPECT_EQ(FullScans::steps(), 0);
  }
}

TEST_F(Lookup, ManyFoldersMayHaveALeaf) {
  ArchiveStore store = ArchiveStore::open_for_writing(path_);
  store.begin();
  const Ground ground = lay_ground(store);
  for (int i = 0; i < 100; ++i) {
    TakeRecord take = sample_take(ground, i);
    take.info.name = "a/" + std::to_string(i) + "/take";
    store.add_take(take, {});
  }
  store.commit();
  EXPECT_EQ(store.take_names_ending_in("take", 1000).size(), 100u);
  EXPECT_EQ(store.take_names_ending_in("take", 10).size(), 10u);
  EXPECT_EQ(store.take_names_ending_in("7/take", 10), std::vector<std::string>{"a/7/take"});
  EXPECT_EQ(store.find_take("a/42/take")->info.frames, 142);
  EXPECT_FALSE(store.find_take("take"));
}

TEST_F(Lookup, AnyOrderOfChangesGivesWhatWasStored) {
  std::mt19937 random(4);
  Ground ground = make_sample(path_, 1);
  std::map<std::string, int> stored = {{sample_take(ground, 0).info.name, 0}};
  for (int round = 0; round < 12; ++round) {
    ArchiveStore store = ArchiveStore::open_for_writing(path_);
    const auto before = stored;
    store.begin();
    for (int change = 0; change < 40; ++change) {
      const int number = static_cast<int>(random() % 150);
      const TakeRecord take = sample_take(ground, number);
      const auto known = store.find_take(take.info.name);
      ASSERT_EQ(known.has_value(), stored.contains(take.info.name));
      if (!known) {
        add_sample(store, ground, number);
        stored[take.info.name] = number;
      } else if (stored.size() > 1 && random() % 3 != 0) {
        store.remove_take(known->info.id);
        stored.erase(take.info.name);
      }
    }
    if (round % 4 == 3) {
      store.roll_back();
      stored = before;
    } else {
      store.commit();
    }
    EXPECT_TRUE(store.check_structure().empty());
    EXPECT_EQ(store.takes({}).size(), stored.size());
    for (const auto& [name, number] : stored) {
      const auto take = store.find_take(name);
      ASSERT_TRUE(take);
      EXPECT_EQ(store.layer(take->info.id, 1), sample_take(ground, number).layers[1].data);
    }
  }
}

TEST_F(Lookup, ReplacingTheOnlyTakeKeepsWhatItNeeds) {
  const Ground ground = make_sample(path_, 1);
  ArchiveStore store = ArchiveStore::open_for_writing(path_);
  store.begin();
  store.remove_take(store.find_take(sample_take(ground, 0).info.name)->info.id);
  add_sample(store, ground, 0);
  store.commit();
  EXPECT_TRUE(store.check_structure().empty());
  EXPECT_EQ(store.skeletons().size(), 1u);
}

}  // namespace
}  // namespace reprise
