// A writer that dies leaves the archive as after one of its commits.
#include <signal.h>
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

}  // namespace
}  // namespace reprise
