// Takes and clips are found without reading the others, and stay findable through changes.
#include <sqlite3.h>

#include <map>

#include "store/database.h"
#include "store/sample_store.h"

namespace reprise {
namespace {

/// What is asked of SQLite on all connections opened while it lives.
class Statements {
 public:
  Statements() {
    forget();
    sqlite3_auto_extension(reinterpret_cast<void (*)()>(&watch));
  }
  ~Statements() { sqlite3_cancel_auto_extension(reinterpret_cast<void (*)()>(&watch)); }
  static void forget() {
    rows_scanned_ = 0;
    texts_.clear();
  }
  /// Rows that statements went through without an index.
  static int rows_scanned() { return rows_scanned_; }
  static const std::vector<std::string>& texts() { return texts_; }

 private:
  static int watch(sqlite3* database, char**, const void*) {
    return sqlite3_trace_v2(database, SQLITE_TRACE_PROFILE, &note, nullptr);
  }
  static int note(unsigned, void*, void* data, void*) {
    auto* statement = static_cast<sqlite3_stmt*>(data);
    const std::string text = sqlite3_sql(statement);
    // FTS5 asks for rows of its own tables, which are in memory, and SQLite for them to drop them.
    if (text.find("words_") != std::string::npos || text.starts_with("DROP")) return 0;
    rows_scanned_ += sqlite3_stmt_status(statement, SQLITE_STMTSTATUS_FULLSCAN_STEP, 0);
    texts_.push_back(text);
    return 0;
  }
  static inline int rows_scanned_ = 0;
  static inline std::vector<std::string> texts_;
};

/// What SQLite's planner says that it would go through row by row to run the statements.
std::vector<std::string> planned_scans(const Database& database,
                                       const std::vector<std::string>& texts) {
  std::vector<std::string> scans;
  const auto words_table = std::ranges::find_if(texts, [](const std::string& text) {
    return text.starts_with("CREATE VIRTUAL TABLE temp.");
  });
  if (words_table != texts.end()) Statement(database, *words_table).run();
  for (const std::string& text : texts) {
    if (text.starts_with("SELECT fts5(")) continue;  // a call, of no table
    if (!text.starts_with("SELECT") && !text.starts_with("DELETE FROM keys")) continue;
    Statement plan(database, "EXPLAIN QUERY PLAN " + text);
    while (plan.step()) {
      for (int i = 0; i < 3; ++i) plan.integer();
      const std::string step = plan.text();
      // An index of FTS5 is one of a virtual table, which SQLite calls a scan, too: M is for MATCH.
      const bool by_words = step.find("VIRTUAL TABLE INDEX") != std::string::npos &&
                            step.find(":M") != std::string::npos;
      if (step.starts_with("SCAN") && !by_words) scans.push_back(text + ": " + step);
    }
  }
  return scans;
}

class Lookup : public StoreTest {};

TEST_F(Lookup, LookupsGoThroughTheIndex) {
  const Statements statements;
  const Ground ground = make_sample(path_, 300);
  const ArchiveStore store = ArchiveStore::open_for_reading(path_);
  store.takes({});
  EXPECT_GT(Statements::rows_scanned(), 0);
  for (const int i : {0, 1, 150, 299}) {
    Statements::forget();
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
    EXPECT_EQ(Statements::rows_scanned(), 0);
  }
}

TEST_F(Lookup, ListsAreFilteredByIndices) {
  const Statements statements;
  make_sample(path_, 300);
  const ArchiveStore store = ArchiveStore::open_for_reading(path_);
  Statements::forget();
  const auto expect_number = [&](const TakeFilter& filter, std::size_t number) {
    EXPECT_EQ(store.takes(filter).size(), number);
  };
  expect_number({"", "subject 1", "", {}}, 150);
  expect_number({"", "no such subject", "", {}}, 0);
  expect_number({"", "", "PERSON walks", {}}, 150);
  expect_number({"", "", "person take_151", {}}, 1);
  expect_number({"", "", "person nothing", {}}, 0);
  expect_number({"", "", "!", {}}, 0);
  expect_number({"", "", "", ClipKind::repeated}, 50);
  expect_number({"", "subject 0", "151", {}}, 0);
  expect_number({"", "subject 1", "151", ClipKind::repeated}, 1);
  expect_number({"take_151", "subject 1", "walks", {}}, 1);
  EXPECT_EQ(Statements::rows_scanned(), 0);
  EXPECT_GT(Statements::texts().size(), 40u);
  const Database database(path_, Database::Mode::read);
  EXPECT_EQ(planned_scans(database, Statements::texts()), std::vector<std::string>());
  EXPECT_EQ(planned_scans(database, {"SELECT id FROM blocks WHERE digest=?"}).size(), 1u);
}

TEST_F(Lookup, OnlyBlocksThatMayHoldAMatchAreRead) {
  make_sample(path_, 640);
  const Statements statements;
  const ArchiveStore watched = ArchiveStore::open_for_reading(path_);
  const auto blocks_read = [&](const TakeFilter& filter) {
    Statements::forget();
    watched.takes(filter);
    return std::ranges::count_if(Statements::texts(), [](const std::string& text) {
      return text.find("FROM blocks") != std::string::npos;
    });
  };
  EXPECT_EQ(blocks_read({"", "", "take_300", {}}), 1);
  EXPECT_EQ(blocks_read({"", "", "nothing", {}}), 0);
  EXPECT_EQ(blocks_read({"", "nobody", "", {}}), 0);
}

TEST_F(Lookup, FiltersSeeWhatIsNotWrittenYet) {
  const Ground ground = make_sample(path_, 100);
  ArchiveStore store = ArchiveStore::open_for_writing(path_);
  store.begin();
  add_sample(store, ground, 121);
  EXPECT_EQ(store.takes({"", "", "take_121", {}}).size(), 1u);
  EXPECT_EQ(store.takes({"", "subject 1", "", {}}).size(), 51u);
  store.remove_take(store.find_take(sample_take(ground, 121).info.name)->info.id);
  EXPECT_EQ(store.takes({"", "", "take_121", {}}).size(), 0u);
  store.commit();
  EXPECT_TRUE(store.check_structure().empty());
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
