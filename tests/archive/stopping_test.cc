// Work that is stopped before there is a take at hand.
#include "archive/archive_fixture.h"
#include "reprise/error.h"

namespace reprise {
namespace {

/// A folder of very many files is stopped like all else, before there is an archive.
TEST_F(ArchiveTest, StopsWhileFoldersAreSearched) {
  fs::create_directories(folder_ / "takes");
  std::ofstream(folder_ / "takes" / "notes.txt") << "no motion\n";
  IngestOptions options;
  options.paths = {folder_ / "takes"};
  EXPECT_THROW(ingest(folder_ / "whole", options, [](const Progress&) { return false; }), Error);
  EXPECT_FALSE(fs::exists(folder_ / "whole"));
}

TEST_F(ArchiveTest, VerifyStopsWhileFoldersAreSearched) {
  synthesise("takes", 1, 1);
  add("whole", {"takes"});
  int calls = 0;
  const auto stop = [&](const Progress& progress) {
    ++calls;
    EXPECT_TRUE(progress.current.empty()) << "no take is looked at yet";
    return false;
  };
  EXPECT_THROW(Archive(folder_ / "whole").verify(folder_ / "takes", {}, stop), Error);
  EXPECT_EQ(calls, 1);
}

TEST_F(ArchiveTest, StopsWhileTakesAreHeldAgainstAStoredSpace) {
  synthesise("takes", 4, 3);
  // So coarse that the others fit, and no axes are added for them.
  constexpr double mean_mm = 1000;
  add("whole", {"takes/s01"}, mean_mm);
  const std::size_t before = Archive(folder_ / "whole").takes().size();
  IngestOptions options;
  options.paths = {folder_ / "takes"};
  options.fidelity = {FidelityTier::preview, mean_mm};
  options.repeats = false;
  // Once takes were looked at, nothing without a name comes but from there.
  bool looked = false, asked = false;
  const auto stop = [&](const Progress& progress) {
    looked = looked || !progress.current.empty();
    asked = looked && progress.current.empty();
    return !asked;
  };
  EXPECT_THROW(ingest(folder_ / "whole", options, stop), Error);
  EXPECT_TRUE(asked);
  EXPECT_EQ(Archive(folder_ / "whole").takes().size(), before);
}

}  // namespace
}  // namespace reprise
