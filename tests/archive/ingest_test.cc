// Takes into an archive and out of it, through the library's own interface.
#include <cstdlib>

#include "archive/archive_fixture.h"
#include "reprise/error.h"

namespace reprise {
namespace {

TEST_F(ArchiveTest, EveryTakeIsWithinItsMean) {
  synthesise("takes", 6, 3);
  for (const double mean : {0.5, 5.0, 20.0, 200.0}) {
    const std::string archive = std::string("a").append(std::to_string(mean));
    EXPECT_EQ(add(archive, {"takes"}, mean).added.size(), 6u);
    expect_all_within(archive, "takes", mean);
  }
  EXPECT_LT(fs::file_size(folder_ / "a20.000000"), fs::file_size(folder_ / "a0.500000"));
}

TEST_F(ArchiveTest, TakesAreAsCoarseAsTheyMayBe) {
  synthesise("takes", 6, 3);
  for (const double mean : {5.0, 20.0}) {
    const std::string archive = std::string("a").append(std::to_string(mean));
    add(archive, {"takes"}, mean);
    for (const TakeInfo& info : Archive(folder_ / archive).takes())
      EXPECT_GE(info.error_mm.mean, 0.85 * mean) << info.name;
  }
}

TEST_F(ArchiveTest, ThreadsAndOrderChangeNothing) {
  synthesise("takes", 6, 4);
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "takes")) {
    if (entry.path().extension() == ".bvh") {
      files.push_back(entry.path().lexically_relative(folder_).generic_string());
    }
  }
  add("one", files, 20, 1);
  std::ranges::reverse(files);
  add("three", files, 20, 3);
  EXPECT_EQ(digest("one"), digest("three"));
}

TEST_F(ArchiveTest, SecondIngestSkipsWhatIsThere) {
  synthesise("takes", 5, 5);
  add("whole", {"takes/s01"});
  const auto report = add("whole", {"takes/s01"});
  EXPECT_TRUE(report.added.empty());
  EXPECT_FALSE(report.skipped.empty());
}

TEST_F(ArchiveTest, AStoppedIngestKeepsWhatIsCoded) {
  synthesise("takes", 4, 7, 2);
  IngestOptions options;
  options.paths = {folder_ / "takes"};
  options.fidelity = {FidelityTier::preview, 20};
  options.jobs = 1;
  int calls = 0;
  ingest(folder_ / "whole", options, [&](const Progress&) { return ++calls > 0; });
  // The last calls are of coded takes: the last but one ends this.
  int left = calls - 1;
  try {
    ingest(folder_ / "stopped", options, [&](const Progress&) { return --left > 0; });
    ADD_FAILURE() << "not stopped";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::interrupted);
  }
  EXPECT_EQ(Archive(folder_ / "stopped").takes().size(), 3u);
  EXPECT_TRUE(Archive(folder_ / "stopped").verify().ok);
  EXPECT_EQ(ingest(folder_ / "stopped", options).added.size(), 1u);
}

TEST_F(ArchiveTest, AStopIsHeededWhileTheAxesAreLearnt) {
  synthesise("takes", 4, 7, 2);
  IngestOptions options;
  options.paths = {folder_ / "takes"};
  options.fidelity = {FidelityTier::preview, 20};
  options.jobs = 1;
  std::size_t last = 0;
  bool asked = false;
  // No take is done where the number of takes done does not grow.
  const auto until_asked = [&](const Progress& progress) {
    asked = asked || progress.done == last;
    last = progress.done;
    return !asked;
  };
  EXPECT_THROW(ingest(folder_ / "stopped", options, until_asked), Error);
  EXPECT_TRUE(asked);
  EXPECT_EQ(ingest(folder_ / "stopped", options).added.size(), 4u);
}

TEST_F(ArchiveTest, LaterTakesThatDoNotFitExtendTheAxes) {
  synthesise("takes", 4, 6);
  // A take of the same skeleton that does what no other does.
  const fs::path one = folder_ / "takes/s01/s01_01.bvh";
  Take wild = read_motion_file(one);
  for (long f = 0; f < wild.frames(); ++f) {
    for (Eigen::Index c = 3; c < wild.channels.cols(); ++c) {
      wild.channels(f, c) +=
          70.0 * std::sin(0.05 * static_cast<double>(f) * static_cast<double>(1 + c % 7) +
                          static_cast<double>(c));
    }
  }
  write("takes/s01/wild.bvh", write_motion(wild));
  fs::rename(folder_ / "takes/s01/wild.bvh", folder_ / "wild.bvh");
  add("archive", {"takes"}, 10);
  ChannelMatrix before;
  {
    const Archive archive(folder_ / "archive");
    before = archive.extract(archive.find_take("s01_01")).channels;
  }
  EXPECT_EQ(add("archive", {"wild.bvh"}, 10).added.size(), 1u);
  const Archive archive(folder_ / "archive");
  EXPECT_EQ(archive.extract(archive.find_take("s01_01")).channels, before);
  const Take decoded = archive.extract(archive.find_take("wild"));
  EXPECT_LE(mean_distance(read_motion_file(folder_ / "wild.bvh"), decoded), 10.0);
}

TEST_F(ArchiveTest, OddTakesAreTakesToo) {
  const std::string joint =
      "JOINT a\n{\nOFFSET 0 10 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
      "End Site\n{\nOFFSET 0 10 0\n}\n}\n";
  const std::string head =
      "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition "
      "Zrotation Xrotation Yrotation\n" +
      joint + "}\nMOTION\n";
  write("odd/one_frame.bvh", head + "Frames: 1\nFrame Time: 0.01\n1 2 3 4 5 6 7 8 9\n");
  write("odd/two_frames.bvh",
        head + "Frames: 2\nFrame Time: 0.01\n1 2 3 4 5 6 7 8 9\n1 2 9 4 5 6 7 80 9\n");
  std::string still = head + "Frames: 50\nFrame Time: 0.01\n";
  for (int f = 0; f < 50; ++f) still += "1 2 3 4 5 6 7 8 9\n";
  write("odd/still.bvh", still);
  write("odd/alone.bvh",
        "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n}\nMOTION\nFrames: 3\nFrame "
        "Time: 0.1\n1\n2\n3\n");
  write("odd/repeated.bvh",
        "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\nCHANNELS 3 Xrotation Yrotation Xrotation\nEnd "
        "Site\n{\nOFFSET 0 50 "
        "0\n}\n}\nMOTION\nFrames: 3\nFrame Time: 0.1\n1 50 3\n2 60 4\n3 70 -100\n");
  const auto report = add("archive", {"odd"}, 1.0);
  EXPECT_EQ(report.added.size(), 5u);
  for (const RejectedInput& input : report.rejected)
    ADD_FAILURE() << input.path << ": " << input.why;
  expect_all_within("archive", "odd", 1.0);
}

TEST_F(ArchiveTest, PartsAreSlicesOfTheWhole) {
  synthesise("takes", 1, 8);
  add("archive", {"takes"});
  const Archive archive(folder_ / "archive");
  const TakeInfo info = archive.takes().at(0);
  const Take whole = archive.extract(info), part = archive.extract(info, {10, 25});
  EXPECT_EQ(part.channels, ChannelMatrix(whole.channels.middleRows(10, 15)));
  EXPECT_THROW(archive.extract(info, {10, info.frames + 1}), Error);
}

TEST_F(ArchiveTest, RemovedTakesLeaveTheOthersAsTheyWere) {
  synthesise("takes", 5, 9);
  add("archive", {"takes"});
  std::vector<std::string> names;
  ChannelMatrix before;
  {
    const Archive archive(folder_ / "archive");
    for (const TakeInfo& info : archive.takes()) names.push_back(info.name);
    before = archive.extract(archive.find_take(names.back())).channels;
  }
  // The first take is the one whose proportions the axes are made for.
  remove_takes(folder_ / "archive", {names[0], names[1]});
  compact(folder_ / "archive");
  const Archive archive(folder_ / "archive");
  EXPECT_EQ(archive.takes().size(), 3u);
  EXPECT_EQ(archive.extract(archive.find_take(names.back())).channels, before);
  EXPECT_TRUE(archive.verify().ok);
  EXPECT_THROW(remove_takes(folder_ / "archive", {"nothing"}), Error);
}

TEST_F(ArchiveTest, ClipsOfEqualContentShareTheirId) {
  synthesise("takes", 2, 10);
  fs::create_directories(folder_ / "copy");
  fs::copy_file(folder_ / "takes/s01/s01_01.bvh", folder_ / "copy/again.bvh");
  add("archive", {"takes", "copy/again.bvh"});
  const Archive archive(folder_ / "archive");
  const auto clips = archive.clips({"again", "", "", {}});
  ASSERT_EQ(clips.size(), 1u);
  EXPECT_EQ(archive.find_clips(clips[0].id).size(), 2u);
  EXPECT_EQ(archive.find(clips[0].id.substr(0, 8)).frames.end, clips[0].frames);
}

TEST_F(ArchiveTest, RealTakesAreWithinTheirMean) {
  const char* data = std::getenv("REPRISE_DATA");
  if (data == nullptr || !fs::exists(data))
    GTEST_SKIP() << "REPRISE_DATA names no folder of real takes";
  IngestOptions options;
  options.fidelity = fidelity_of(FidelityTier::preview);
  options.jobs = 2;
  for (const char* file :
       {"cmu-asfamc/02/02_01.amc", "cmu-asfamc/01/01_01.amc", "cmu-iclone-bvh/007_01.bvh",
        "cmu-iclone-bvh/005_01.bvh", "bandai-namco/dataset-1_bow_angry_001.bvh",
        "bandai-namco/dataset-1_kick_normal_001.bvh"}) {
    if (fs::exists(fs::path(data) / file)) options.paths.push_back(fs::path(data) / file);
  }
  if (options.paths.empty()) GTEST_SKIP() << "none of the takes that this test knows is there";
  const auto report = ingest(folder_ / "real", options);
  EXPECT_EQ(report.added.size(), options.paths.size());
  const Archive archive(folder_ / "real");
  for (const fs::path& path : options.paths) {
    const Take source = read_motion_file(path);
    const Take decoded = archive.extract(archive.find_take(path.stem().string()));
    EXPECT_LE(compare_takes(source, decoded).errors.mean, 20.0) << path;
    if (source.skeleton->format == MotionFormat::bvh) {
      EXPECT_LE(mean_distance(source, decoded), 20.0) << path;
    }
  }
}

}  // namespace
}  // namespace reprise
