// No damage is silent: what is read is what was stored, or an error.
#include <sqlite3.h>

#include "store/compression.h"
#include "store/page_checksum_vfs.h"
#include "store/sample_store.h"

namespace reprise {
namespace {

class Damage : public StoreTest {
 protected:
  /// Reads everything of a changed archive: an error of the right kind, or what was there before.
  void expect_error_or(const std::string& bytes, const std::string& before,
                       const std::string& what) {
    write_bytes(path_, bytes);
    try {
      EXPECT_EQ(everything(ArchiveStore::open_for_reading(path_)), before) << what;
    } catch (const Error& error) {
      EXPECT_TRUE(error.code() == ErrorCode::damaged || error.code() == ErrorCode::newer_version)
          << what << ": " << error.what();
    }
  }

  void run_sql(const std::string& sql) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open_v2(path_.c_str(), &database, SQLITE_OPEN_READWRITE, page_checksum_vfs()),
              SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(database);
    sqlite3_close(database);
  }
};

TEST_F(Damage, FlippedBitsAreErrorsOrChangeNothing) {
  make_sample(path_, 4);
  const std::string good = read_bytes(path_);
  const std::string before = everything(ArchiveStore::open_for_reading(path_));
  std::mt19937 random(1);
  for (std::size_t at = 0; at < good.size(); at += at < 128 ? 1 : 23) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ (1 << random() % 8));
    expect_error_or(bad, before, "byte " + std::to_string(at));
  }
}

TEST_F(Damage, CheckFindsEveryFlippedBit) {
  make_sample(path_, 3);
  const std::string good = read_bytes(path_);
  std::mt19937 random(2);
  for (std::size_t at = 100; at < good.size(); at += 211) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ (1 << random() % 8));
    write_bytes(path_, bad);
    try {
      EXPECT_FALSE(ArchiveStore::open_for_reading(path_).check_structure().empty()) << at;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::damaged);
    }
  }
}

TEST_F(Damage, CutAndLengthenedFilesAreErrors) {
  make_sample(path_, 3);
  const std::string good = read_bytes(path_);
  for (std::size_t size = 0; size < good.size(); size += 331) {
    write_bytes(path_, good.substr(0, size));
    EXPECT_EQ(code_when_opened(path_), ErrorCode::damaged) << size;
  }
  for (const std::size_t more : {1u, 8u, 512u, 1024u, 4096u}) {
    write_bytes(path_, good + std::string(more, '\0'));
    EXPECT_EQ(code_when_opened(path_), ErrorCode::damaged) << more;
  }
}

TEST_F(Damage, SwappedPagesAreErrors) {
  make_sample(path_, 8);
  const std::string good = read_bytes(path_);
  const std::string before = everything(ArchiveStore::open_for_reading(path_));
  const std::size_t page = good.size() > 4096 ? 1024 : 512;
  for (std::size_t first = page; first + 2 * page <= good.size(); first += page) {
    std::string bad = good.substr(0, first) + good.substr(first + page, page) +
                      good.substr(first, page) + good.substr(first + 2 * page);
    expect_error_or(bad, before, "pages at " + std::to_string(first));
  }
}

TEST_F(Damage, OtherFilesAreNotArchives) {
  for (const std::string& bytes :
       {std::string("hello"), std::string(5000, 'x'), std::string("SQLite format 3\0", 16),
        std::string(), std::string(100, '\0')}) {
    write_bytes(path_, bytes);
    EXPECT_EQ(code_when_opened(path_), ErrorCode::damaged);
  }
  EXPECT_EQ(code_when_opened(folder_ / "missing"), ErrorCode::failed);
}

TEST_F(Damage, NewerFormatsAreNamed) {
  make_sample(path_, 1);
  run_sql("PRAGMA user_version=2000");
  EXPECT_EQ(code_when_opened(path_), ErrorCode::newer_version);
}

TEST_F(Damage, ForeignTablesAndTriggersAreRefused) {
  for (const char* sql : {"CREATE TABLE more(x)", "CREATE VIEW v AS SELECT 1",
                          "CREATE TRIGGER t AFTER INSERT ON blocks BEGIN DELETE FROM blocks; END",
                          "CREATE INDEX i ON keys(more)", "DROP TABLE keys"}) {
    fs::remove(path_);
    make_sample(path_, 1);
    run_sql(sql);
    EXPECT_EQ(code_when_opened(path_), ErrorCode::damaged) << sql;
  }
}

TEST_F(Damage, RowsThatWereChangedAreErrors) {
  // Pages are whole here, since this writer keeps their checksums: the digests of the rows must
  // tell.
  for (const char* sql :
       {"UPDATE blocks SET takes=substr(takes,1,9)||x'ff'||substr(takes,11)",
        "UPDATE blocks SET takes=substr(takes,1,length(takes)-1)",
        "UPDATE blocks SET takes=x'', digest=x'' WHERE id=1",
        "UPDATE blocks SET digest=x'0011223344556677'",
        "UPDATE blocks SET data=substr(data,2)||x'00' WHERE id=1",
        "UPDATE blocks SET data=zeroblob(length(data)) WHERE id=1",
        "UPDATE blocks SET data=x'' WHERE id=1",
        "UPDATE blocks SET data=(SELECT data FROM blocks WHERE id=2) WHERE id=1",
        "UPDATE blocks SET (takes,digest,data)=(SELECT takes,digest,data FROM blocks WHERE id=2)",
        "UPDATE blocks SET id=id+7", "UPDATE blocks SET id=(1<<58)+id", "UPDATE blocks SET id=-id",
        "UPDATE proportions SET frame_rate=60", "UPDATE proportions SET id=9",
        "UPDATE skeletons SET channels=channels+1", "UPDATE spaces SET data=x'28b52ffd'"}) {
    fs::remove(path_);
    make_sample(path_, 70);  // fills more than one block
    run_sql(sql);
    EXPECT_EQ(code_when_opened(path_), ErrorCode::damaged) << sql;
  }
}

TEST_F(Damage, MissingRowsAreFoundByTheCheck) {
  for (const char* sql :
       {"DELETE FROM blocks WHERE id=1", "INSERT INTO keys VALUES(9999, x'00')",
        "DELETE FROM keys WHERE id=(SELECT max(id) FROM keys)", "UPDATE keys SET id=id+1",
        "UPDATE keys SET id=-id", "UPDATE keys SET more=x''", "UPDATE keys SET more=x'00'",
        "UPDATE keys SET more=x'7f'", "UPDATE keys SET more=more||x'00'",
        "UPDATE keys SET id=9223372036854775807 WHERE id=(SELECT max(id) FROM keys)",
        "UPDATE blocks SET data=data||x'00' WHERE id=1"}) {
    fs::remove(path_);
    make_sample(path_, 9);
    ASSERT_TRUE(ArchiveStore::open_for_reading(path_).check_structure().empty());
    run_sql(sql);
    EXPECT_FALSE(ArchiveStore::open_for_reading(path_).check_structure().empty()) << sql;
  }
}

TEST_F(Damage, AClipThatRepeatsNothingIsFoundByTheCheck) {
  // Blocks that are whole, and hold clips whose primaries are not there.
  for (const ClipPlace& nowhere : {ClipPlace{4711, 0}, ClipPlace{1 << 30, 0}, ClipPlace{0, 7}}) {
    fs::remove(path_);
    ArchiveStore store = ArchiveStore::open_for_writing(path_);
    store.begin();
    const Ground ground = lay_ground(store);
    std::vector<ClipRecord> clips = sample_clips(1);
    clips[1].primary_place = nowhere;
    EXPECT_THROW(store.add_take(sample_take(ground, 1), clips), Error);
    store.roll_back();
  }
}

TEST_F(Damage, OtherBlocksStayReadable) {
  const Ground ground = make_sample(path_, 200);
  run_sql("UPDATE blocks SET takes=x'00' WHERE id=2");
  const ArchiveStore store = ArchiveStore::open_for_reading(path_);
  int read = 0, damaged = 0;
  for (int i = 0; i < 200; ++i) {
    try {
      const auto take = store.find_take(sample_take(ground, i).info.name);
      ASSERT_TRUE(take);
      EXPECT_EQ(store.layer(take->info.id, 1), sample_take(ground, i).layers[1].data);
      ++read;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::damaged);
      ++damaged;
    }
  }
  EXPECT_GT(damaged, 0);
  EXPECT_LE(damaged, 64);
  EXPECT_EQ(read + damaged, 200);
}

TEST(Compression, FramesComeBack) {
  for (const std::size_t size : {0u, 1u, 1000u, 200000u}) {
    const Bytes bytes = random_bytes(size, 3), prefix = random_bytes(5000, 4);
    EXPECT_EQ(decompress(compress(bytes, false), size), bytes);
    EXPECT_EQ(decompress(compress(bytes, true, prefix), size, prefix), bytes);
  }
}

TEST(Compression, LargeClaimsAreRefused) {
  const Bytes frame = compress(Bytes(100000, 7), true);
  EXPECT_THROW(decompress(frame, 99999), Error);
  EXPECT_THROW(decompress(random_bytes(50, 5), 1000), Error);
  for (std::size_t size = 0; size < frame.size(); ++size) {
    EXPECT_THROW(decompress(std::span(frame).first(size), 100000), Error);
  }
}

}  // namespace
}  // namespace reprise
