// A writer that dies leaves the archive as after one of its commits.
#include <signal.h>
#include <sqlite3.h>
#include <sys/wait.h>

#include "store/sample_store.h"

namespace reprise {
namespace {

class Crash : public StoreTest {};

/// Adds takes two by two until it is killed.
[[noreturn]] void write_until_killed(const fs::path& path) {
  ArchiveStore store = ArchiveStore::open_for_writing(path);
  Ground ground;
  for (int i = 0;; i += 2) {
    store.begin();
    if (i == 0) ground = lay_ground(store);
    add_sample(store, ground, i);
    add_sample(store, ground, i + 1);
    store.commit();
  }
}

TEST_F(Crash, KilledWritersLeaveWholeBatches) {
  std::size_t stored = 0;
  for (int run = 0; run < 20; ++run) {
    fs::remove(path_);
    fs::remove(path_.string() + "-journal");
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) write_until_killed(path_);
    usleep(static_cast<useconds_t>(3000 + 20000 * run));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    // There is no file yet, or a whole archive.
    if (!fs::exists(path_)) continue;
    {
      const ArchiveStore store = ArchiveStore::open_for_reading(path_);
      EXPECT_EQ(store.takes({}).size() % 2, 0u);
      EXPECT_TRUE(store.check_structure().empty());
      stored += store.takes({}).size();
    }
    // Whatever was left, writing goes on from there.
    ArchiveStore store = ArchiveStore::open_for_writing(path_);
    store.begin();
    const Ground ground = lay_ground(store);
    add_sample(store, ground, 1000000);
    store.commit();
    EXPECT_TRUE(store.check_structure().empty());
  }
  EXPECT_GT(stored, 0u);
}

/// A file as a writer leaves it that dies within a commit, with its journal beside it.
void leave_unfinished(const fs::path& whole, const fs::path& left) {
  sqlite3* writer = nullptr;
  ASSERT_EQ(sqlite3_open(whole.c_str(), &writer), SQLITE_OK);
  const char* change =
      "PRAGMA cache_size=1; BEGIN IMMEDIATE; UPDATE blocks SET data=zeroblob(length(data)), "
      "takes=zeroblob(length(takes)); UPDATE spaces SET data=zeroblob(length(data))";
  ASSERT_EQ(sqlite3_exec(writer, change, nullptr, nullptr, nullptr), SQLITE_OK);
  fs::copy_file(whole, left);
  fs::copy_file(whole.string() + "-journal", left.string() + "-journal");
  sqlite3_close_v2(writer);
}

TEST_F(Crash, WhatIsLeftUnfinishedIsTakenBackThroughALink) {
  {
    ArchiveStore store = ArchiveStore::open_for_writing(path_);
    store.begin();
    const Ground ground = lay_ground(store);
    for (int i = 0; i < 40; ++i) add_sample(store, ground, i);
    store.commit();
  }
  fs::path left = path_, link = path_;
  left += ".left";
  link += ".link";
  leave_unfinished(path_, left);
  fs::create_symlink(left, link);
  {
    const ArchiveStore store = ArchiveStore::open_for_reading(link);
    EXPECT_EQ(store.takes({}).size(), 40u);
    EXPECT_TRUE(store.check_structure().empty());
  }
  EXPECT_FALSE(fs::exists(left.string() + "-journal"));
  for (const fs::path& file : {left, link}) fs::remove(file);
}

}  // namespace
}  // namespace reprise
