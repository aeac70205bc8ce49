// Takes into an archive and out of it, through the library's own interface.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>

#include "reprise/archive.h"
#include "reprise/error.h"
#include "reprise/synth/library.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

/// Places of all joints, in mm, by a way of its own: nothing here is shared with the library.
std::vector<double> places(const Skeleton& skeleton, const ChannelMatrix& channels, long frame) {
  using M = std::array<double, 9>;
  const auto times = [](const M& a, const M& b) {
    M c{};
    for (int i = 0; i < 9; ++i) {
      for (int k = 0; k < 3; ++k) c[i] += a[i / 3 * 3 + k] * b[k * 3 + i % 3];
    }
    return c;
  };
  const auto about = [](int axis, double degrees) {
    const double c = std::cos(degrees * std::numbers::pi / 180),
                 s = std::sin(degrees * std::numbers::pi / 180);
    if (axis == 0) return M{1, 0, 0, 0, c, -s, 0, s, c};
    if (axis == 1) return M{c, 0, s, 0, 1, 0, -s, 0, c};
    return M{c, -s, 0, s, c, 0, 0, 0, 1};
  };
  std::vector<M> turned;
  std::vector<std::array<double, 3>> at;
  std::vector<double> result;
  for (const Joint& joint : skeleton.joints) {
    const M parent = joint.parent < 0 ? M{1, 0, 0, 0, 1, 0, 0, 0, 1} : turned[joint.parent];
    std::array<double, 3> place = joint.parent < 0 ? std::array<double, 3>{} : at[joint.parent];
    std::array<double, 3> t = {joint.offset[0], joint.offset[1], joint.offset[2]};
    M rotation = parent;
    for (std::size_t c = 0; c < joint.channels.size(); ++c) {
      const double value = channels(frame, joint.first_channel + static_cast<Eigen::Index>(c));
      const int kind = static_cast<int>(joint.channels[c]);
      if (kind < 3) {
        t[kind] = value;
      } else {
        rotation = times(rotation, about(kind - 3, value));
      }
    }
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k)
        place[i] += parent[i * 3 + k] * t[k] * skeleton.millimetres_per_unit;
      result.push_back(place[i]);
    }
    turned.push_back(rotation);
    at.push_back(place);
  }
  return result;
}

double mean_distance(const Take& a, const Take& b) {
  double sum = 0;
  std::size_t count = 0;
  for (long f = 0; f < a.frames(); ++f) {
    const auto p = places(*a.skeleton, a.channels, f), q = places(*b.skeleton, b.channels, f);
    for (std::size_t j = 0; j + 2 < p.size(); j += 3) {
      sum += std::hypot(p[j] - q[j], p[j + 1] - q[j + 1], p[j + 2] - q[j + 2]);
      ++count;
    }
  }
  return sum / static_cast<double>(count);
}

class ArchiveTest : public testing::Test {
 protected:
  ArchiveTest() {
    std::string pattern = (fs::temp_directory_path() / "reprise-test-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~ArchiveTest() override { fs::remove_all(folder_); }

  void synthesise(const std::string& name, std::size_t takes, std::uint64_t seed,
                  double seconds = 4) {
    SynthOptions options;
    options.takes = takes;
    options.seconds = seconds;
    options.subjects = 2;
    options.seed = seed;
    write_synthetic_library(folder_ / name, options, true);
  }
  void write(const std::string& name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  IngestReport add(const std::string& archive, const std::vector<std::string>& names,
                   double mean_mm = 20, unsigned jobs = 2) {
    IngestOptions options;
    for (const std::string& name : names) options.paths.push_back(folder_ / name);
    options.fidelity.limit_mm = mean_mm;
    options.jobs = jobs;
    return ingest(folder_ / archive, options);
  }
  void expect_all_within(const std::string& archive, const std::string& sources, double mean_mm) {
    const Archive stored(folder_ / archive);
    for (const TakeInfo& info : stored.takes()) {
      fs::path path = folder_ / sources / info.name;
      const Take source = read_motion_file(path += ".bvh");
      const Take decoded = stored.extract(info);
      ASSERT_EQ(decoded.frames(), source.frames());
      ASSERT_EQ(decoded.layout.frame_time_text, source.layout.frame_time_text);
      ASSERT_EQ(decoded.skeleton->source_text, source.skeleton->source_text);
      const double mean = mean_distance(source, decoded);
      EXPECT_LE(mean, mean_mm) << info.name;
      EXPECT_NEAR(mean, info.error_mm.mean, 0.01) << info.name;
    }
  }
  std::string digest(const std::string& archive) {
    return Archive(folder_ / archive).info().content_digest;
  }

  fs::path folder_;
};

TEST_F(ArchiveTest, EveryTakeIsWithinItsMean) {
  synthesise("takes", 6, 3);
  for (const double mean : {0.5, 5.0, 20.0, 200.0}) {
    const std::string archive = "a" + std::to_string(mean);
    EXPECT_EQ(add(archive, {"takes"}, mean).added.size(), 6u);
    expect_all_within(archive, "takes", mean);
  }
  EXPECT_LT(fs::file_size(folder_ / "a20.000000"), fs::file_size(folder_ / "a0.500000"));
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
