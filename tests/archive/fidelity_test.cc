// What each fidelity promises, measured on what comes out.
#include <cstdlib>
#include <random>

#include "archive/archive_fixture.h"
#include "formats/samples.h"
#include "reprise/error.h"

namespace reprise {
namespace {

class FidelityTest : public ArchiveTest {
 protected:
  IngestReport store(const std::string& archive, const std::vector<fs::path>& paths,
                     const Fidelity& fidelity) {
    IngestOptions options;
    options.paths = paths;
    options.fidelity = fidelity;
    options.jobs = 2;
    return ingest(folder_ / archive, options);
  }

  /// The take as its written file says, since that is what users get.
  static Take written(const Take& take) { return read_bvh(write_motion(take), take.name); }

  void expect_bound(const std::string& archive, const std::string& sources, double bound_mm) {
    const Archive stored(folder_ / archive);
    for (const TakeInfo& info : stored.takes()) {
      const fs::path path = (folder_ / sources / info.name).concat(".bvh");
      const Take source = read_motion_file(path);
      const double worst = greatest_distance(source, written(stored.extract(info)));
      EXPECT_LE(worst, bound_mm) << info.name;
      EXPECT_NEAR(worst, info.error_mm.max, 0.01) << info.name;
    }
    EXPECT_TRUE(stored.verify(folder_ / sources).ok);
  }

  /// Joints thrown about between single frames, as capture errors do, and angles beyond a turn.
  void make_wild(const std::string& source, const std::string& target) {
    Take take = read_motion_file(folder_ / source);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-200.0, 200.0);
    for (long f = 5; f < take.frames(); f += 17) {
      for (Eigen::Index c = 0; c < take.channels.cols(); c += 3) take.channels(f, c) += any(random);
    }
    for (long f = 0; f < take.frames(); ++f) take.channels(f, 5) += 3.0 * static_cast<double>(f);
    write(target, write_motion(take));
  }
};

TEST_F(FidelityTest, EveryJointOfEveryFrameIsWithinTheBound) {
  synthesise("takes", 4, 21, 3);
  make_wild("takes/s01/s01_01.bvh", "takes/wild.bvh");
  store("standard", {folder_ / "takes"}, fidelity_of(FidelityTier::standard));
  expect_bound("standard", "takes", 10.0);
  store("fine", {folder_ / "takes"}, fidelity_of(FidelityTier::fine));
  expect_bound("fine", "takes", 1.0);
  for (const double bound : {0.05, 3.0, 100.0}) {
    const std::string archive = "bound" + std::to_string(bound);
    store(archive, {folder_ / "takes"}, {FidelityTier::bound, bound});
    expect_bound(archive, "takes", bound);
  }
}

TEST_F(FidelityTest, LowerFidelitiesAreInTheHigherOnes) {
  synthesise("takes", 2, 22, 3);
  store("fine", {folder_ / "takes"}, fidelity_of(FidelityTier::fine));
  const Archive archive(folder_ / "fine");
  for (const TakeInfo& info : archive.takes()) {
    const Take source = read_motion_file((folder_ / "takes" / info.name).concat(".bvh"));
    EXPECT_LE(greatest_distance(source, archive.extract(info, FidelityTier::fine)), 1.0);
    EXPECT_LE(greatest_distance(source, archive.extract(info, FidelityTier::standard)), 10.0);
    EXPECT_LE(mean_distance(source, archive.extract(info, FidelityTier::preview)), 20.0);
    EXPECT_THROW(archive.extract(info, FidelityTier::exact), Error);
    EXPECT_THROW(archive.source_text(info), Error);
  }
}

TEST_F(FidelityTest, ExactGivesTheSourceByteForByte) {
  int number = 0;
  for (const Sample& sample : samples()) {
    const std::string name = "take" + std::to_string(number++);
    if (sample.skeleton.empty()) {
      write("sources/" + name + ".bvh", sample.motion);
    } else {
      write("sources/" + name + ".asf", sample.skeleton);
      write("sources/" + name + ".amc", sample.motion);
    }
  }
  synthesise("sources/more", 2, 23, 2);
  const auto report = store("exact", {folder_ / "sources"}, fidelity_of(FidelityTier::exact));
  EXPECT_TRUE(report.rejected.empty());
  const Archive archive(folder_ / "exact");
  for (const TakeInfo& info : archive.takes()) {
    const bool bvh = info.format == MotionFormat::bvh;
    const fs::path path = (folder_ / "sources" / info.name).concat(bvh ? ".bvh" : ".amc");
    EXPECT_EQ(archive.source_text(info), read_whole_file(path)) << info.name;
    EXPECT_EQ(info.error_mm.max, 0) << info.name;
    const Take decoded = archive.extract(info);
    EXPECT_EQ(decoded.channels, read_motion_file(path).channels) << info.name;
    if (bvh) continue;
    EXPECT_EQ(decoded.skeleton->source_text,
              read_whole_file(fs::path(path).replace_extension("asf")));
  }
  EXPECT_TRUE(archive.verify(folder_ / "sources").ok);
}

TEST_F(FidelityTest, VerifyTellsASourceThatIsNoLongerTheSame) {
  synthesise("takes", 2, 24, 2);
  for (const FidelityTier tier : {FidelityTier::standard, FidelityTier::exact}) {
    const fs::path path = folder_ / "takes/s01/s01_01.bvh";
    const std::string archive = tier_name(tier), text = read_whole_file(path);
    store(archive, {folder_ / "takes"}, fidelity_of(tier));
    EXPECT_TRUE(Archive(folder_ / archive).verify(folder_ / "takes").ok);
    Take moved = read_bvh(text, "moved");
    moved.channels(moved.frames() / 2, 0) += 30.0;
    write("takes/s01/s01_01.bvh", write_motion(moved));
    const VerifyReport report = Archive(folder_ / archive).verify(folder_ / "takes");
    ASSERT_FALSE(report.damaged.empty()) << archive;
    EXPECT_EQ(report.damaged[0].id, "s01/s01_01");
    EXPECT_TRUE(report.damaged[0].outside_fidelity);
    write("takes/s01/s01_01.bvh", text);
  }
}

TEST_F(FidelityTest, RealTakesAreWithinTheirBound) {
  const char* data = std::getenv("REPRISE_DATA");
  if (data == nullptr || !fs::exists(data))
    GTEST_SKIP() << "REPRISE_DATA names no folder of real takes";
  std::vector<fs::path> paths;
  for (const char* file : {"cmu-asfamc/02/02_01.amc", "cmu-iclone-bvh/007_01.bvh",
                           "bandai-namco/dataset-1_bow_angry_001.bvh"}) {
    if (fs::exists(fs::path(data) / file)) paths.push_back(fs::path(data) / file);
  }
  if (paths.empty()) GTEST_SKIP() << "none of the takes that this test knows is there";
  for (const FidelityTier tier :
       {FidelityTier::standard, FidelityTier::fine, FidelityTier::exact}) {
    EXPECT_EQ(store(tier_name(tier), paths, fidelity_of(tier)).added.size(), paths.size());
    const Archive archive(folder_ / tier_name(tier));
    for (const fs::path& path : paths) {
      const Take source = read_motion_file(path);
      const Take decoded = archive.extract(archive.find_take(path.stem().string()));
      EXPECT_LE(compare_takes(source, decoded).errors.max, fidelity_of(tier).limit_mm) << path;
    }
  }
}

}  // namespace
}  // namespace reprise
