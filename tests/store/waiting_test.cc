// A change waits for those that read the archive, says so, and not for other programs that write.
#include <sqlite3.h>

#include "reprise/error.h"
#include "store/database.h"
#include "store/sample_store.h"
#include "store/writer_lock.h"

namespace reprise {
namespace {

class WaitingTest : public StoreTest {
 protected:
  ErrorCode code_of_compacting(WaitNotice waiting = {}) {
    try {
      ArchiveStore::open_for_writing(path_, std::move(waiting)).compact();
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode{};
  }
};

TEST_F(WaitingTest, ACommitWaitsUntilTheReadersAreDone) {
  const Ground ground = make_sample(path_, 2);
  const ArchiveStore reader = ArchiveStore::open_for_reading(path_);
  ArchiveStore::Snapshot snapshot = reader.snapshot();
  int told = 0;
  ArchiveStore writer = ArchiveStore::open_for_writing(path_, [&] {
    ++told;
    snapshot.reset();
    return true;
  });
  writer.begin();
  add_sample(writer, ground, 5);
  writer.commit();
  EXPECT_EQ(told, 1);
  EXPECT_EQ(reader.takes({}).size(), 3u);
}

TEST_F(WaitingTest, AWriterThatGivesUpLeavesTheArchiveAsItWas) {
  const Ground ground = make_sample(path_, 2);
  const std::string before = read_bytes(path_);
  {
    const ArchiveStore reader = ArchiveStore::open_for_reading(path_);
    const ArchiveStore::Snapshot snapshot = reader.snapshot();
    ArchiveStore writer = ArchiveStore::open_for_writing(path_, [] { return false; });
    writer.begin();
    add_sample(writer, ground, 5);
    try {
      writer.commit();
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::interrupted);
    }
    EXPECT_EQ(reader.takes({}).size(), 2u);
  }
  EXPECT_EQ(read_bytes(path_), before);
}

TEST_F(WaitingTest, CompactingTellsThatItWaitsForReadersAlone) {
  make_sample(path_, 2);
  {
    const ArchiveStore reader = ArchiveStore::open_for_reading(path_);
    ArchiveStore::Snapshot snapshot = reader.snapshot();
    EXPECT_EQ(code_of_compacting([&] {
                snapshot.reset();
                return true;
              }),
              ErrorCode{});
  }
  Database other(path_, Database::Mode::write);
  other.run("BEGIN IMMEDIATE");
  bool told = false;
  EXPECT_EQ(code_of_compacting([&] { return told = true; }), ErrorCode::locked);
  EXPECT_FALSE(told);
}

TEST_F(WaitingTest, WhatAWriterLeftThatDiedWhileItMadeAnArchiveIsTakenAway) {
  for (const char* end : {"", "-journal"})
    write_bytes(path_.string() + ".new-0123456789abcdef" + end, "a part of an archive");
  make_sample(path_, 1);
  for (const auto& entry : fs::directory_iterator(folder_)) EXPECT_EQ(entry.path(), path_);
}

// As `mktemp` leaves one.
TEST_F(WaitingTest, AnEmptyFileBecomesAnArchiveForOneWriterAndStays) {
  std::ofstream(path_).close();
  {
    const ArchiveStore writer = ArchiveStore::open_for_writing(path_);
    EXPECT_THROW(ArchiveStore::open_for_writing(path_), Error);
  }
  EXPECT_TRUE(ArchiveStore::open_for_reading(path_).takes({}).empty());
}

TEST_F(WaitingTest, AnEmptyFileThatAnotherProcessHasLockedIsLeftAlone) {
  std::ofstream(path_).close();
  const WriterLock other(path_, false);
  EXPECT_THROW(ArchiveStore::open_for_writing(path_), Error);
  EXPECT_EQ(fs::file_size(path_), 0u);
}

// What is not an archive is not ours to mend, either.
TEST_F(WaitingTest, AnotherProgramsUnfinishedChangeIsLeftAlone) {
  const fs::path theirs = folder_ / "theirs.db", left = folder_ / "left.db";
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(theirs.c_str(), &database), SQLITE_OK);
  const auto run = [&](const char* sql) {
    ASSERT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sql;
  };
  run("CREATE TABLE t(x); INSERT INTO t VALUES(zeroblob(20000)); PRAGMA cache_size=1; BEGIN; "
      "UPDATE t SET x=randomblob(20000); PRAGMA cache_spill=1; INSERT INTO t "
      "VALUES(randomblob(90000))");
  for (const char* end : {"", "-journal"}) {
    ASSERT_TRUE(fs::exists(theirs.string() + end));
    fs::copy_file(theirs.string() + end, left.string() + end);
  }
  sqlite3_close(database);
  const std::string before = read_bytes(left), journal = read_bytes(left.string() + "-journal");
  EXPECT_THROW(ArchiveStore::open_for_reading(left), Error);
  EXPECT_EQ(read_bytes(left), before);
  EXPECT_EQ(read_bytes(left.string() + "-journal"), journal);
}

}  // namespace
}  // namespace reprise
