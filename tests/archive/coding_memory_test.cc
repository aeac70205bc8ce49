#include "archive/archive_fixture.h"
#include "archive/coded_take.h"

namespace reprise {
namespace {

TEST(CodingMemoryTest, LongerTakesNeedMore) {
  Skeleton skeleton;
  skeleton.channel_count = 60;
  skeleton.joints.resize(20);
  EXPECT_EQ(coding_memory(skeleton, 0), 0u);
  EXPECT_EQ(coding_memory(skeleton, 2000), 2 * coding_memory(skeleton, 1000));
}

/// What is too long for the machine is told, and the rest of its library goes on.
TEST_F(ArchiveTest, ATakeThatNeedsMoreMemoryThanThereIsIsRejected) {
  synthesise("takes", 2, 1);
  const fs::path source = *fs::recursive_directory_iterator(folder_ / "takes" / "s01");
  std::ifstream in(source);
  std::ofstream out(folder_ / "takes" / "long.bvh");
  std::vector<std::string> frames;
  bool motion = false;
  for (std::string line; std::getline(in, line);) {
    if (motion) {
      frames.push_back(line);
    } else if (line.starts_with("Frames:")) {
      continue;  // as many as there are
    } else if (line.starts_with("Frame Time:")) {
      motion = true;
      frames.push_back(line);
    } else {
      out << line << '\n';
    }
  }
  constexpr int times = 5;
  out << "Frames: " << times * (frames.size() - 1) << '\n' << frames.front() << '\n';
  for (int n = 0; n < times; ++n) {
    for (std::size_t f = 1; f < frames.size(); ++f) out << frames[f] << '\n';
  }
  out.close();

  IngestOptions options;
  options.paths = {folder_ / "takes"};
  options.fidelity = {FidelityTier::preview, 20};
  options.jobs = 2;
  options.memory_bytes = 10'000'000;
  const IngestReport report = ingest(folder_ / "whole", options, {});
  EXPECT_EQ(report.added.size(), 2u);
  ASSERT_EQ(report.rejected.size(), 1u);
  EXPECT_EQ(report.rejected.front().path, (folder_ / "takes" / "long.bvh").string());
  EXPECT_NE(report.rejected.front().why.find("memory"), std::string::npos);
  options.memory_bytes = 0;
  EXPECT_EQ(ingest(folder_ / "whole", options, {}).added, std::vector<std::string>{"long"});
}

}  // namespace
}  // namespace reprise
