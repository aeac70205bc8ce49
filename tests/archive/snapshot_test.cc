// Readers and a writer at the same time: what a reader is told is one state of the archive, and
// what is taken out meanwhile is no damage.
#include "archive/archive_fixture.h"
#include "reprise/error.h"

namespace reprise {
namespace {

class SnapshotTest : public ArchiveTest {
 protected:
  SnapshotTest() {
    synthesise("takes", 6, 1, 2);
    add("lib.rpz", {"takes"});
  }

  void remove_last() const {
    remove_takes(folder_ / "lib.rpz", {Archive(folder_ / "lib.rpz").takes().back().name});
  }
};

TEST_F(SnapshotTest, TakesThatGoDuringAVerifyAreNoDamage) {
  const Archive archive(folder_ / "lib.rpz");
  const VerifyReport report = archive.verify({}, {}, [&](const Progress& progress) {
    if (progress.done < 3) remove_last();
    return true;
  });
  EXPECT_TRUE(report.ok) << (report.damaged.empty() ? "" : report.damaged[0].why);
  EXPECT_EQ(archive.takes().size(), 3u);
}

TEST_F(SnapshotTest, TakesThatComeDuringAVerifyAreNoDamage) {
  synthesise("more", 6, 2, 2);
  const VerifyReport report =
      Archive(folder_ / "lib.rpz").verify({}, {}, [&](const Progress& progress) {
        if (progress.done == 1) add("lib.rpz", {"more"});
        return true;
      });
  EXPECT_TRUE(report.ok);
  EXPECT_EQ(report.takes, 6u);
}

TEST_F(SnapshotTest, ATakeThatWasTakenOutIsNotFound) {
  const Archive archive(folder_ / "lib.rpz");
  const TakeInfo info = archive.takes().back();
  remove_last();
  try {
    archive.extract(info);
    FAIL() << "what is gone was decoded";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_found);
  }
}

TEST_F(SnapshotTest, ATakeThatWasReplacedIsNotTheOneThatWasFound) {
  const Archive archive(folder_ / "lib.rpz");
  const TakeInfo info = archive.takes().back();
  remove_last();
  fs::remove_all(folder_ / "takes");
  synthesise("takes", 6, 3, 1);
  add("lib.rpz", {"takes"});
  EXPECT_THROW(archive.extract(info, {0, info.frames}), Error);
}

TEST_F(SnapshotTest, AnOpenArchiveSeesWhatIsAddedToIt) {
  const Archive archive(folder_ / "lib.rpz");
  for (const TakeInfo& take : archive.takes()) archive.extract(take);
  // Everything goes, and other skeletons' rows may get the same numbers.
  for (int i = 0; i < 6; ++i) remove_last();
  synthesise("others", 6, 4, 2);
  add("lib.rpz", {"others"});
  expect_all_within("lib.rpz", "others", 20);
  for (const TakeInfo& take : archive.takes()) {
    const Take decoded = archive.extract(take);
    EXPECT_EQ(decoded.channels, Archive(folder_ / "lib.rpz").extract(take).channels);
  }
}

}  // namespace
}  // namespace reprise
