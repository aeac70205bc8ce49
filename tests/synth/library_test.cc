// What a synthetic library promises as a whole: it is the same every time, and its truth is true.
#include "reprise/synth/library.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "reprise/error.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

SynthOptions small_options(MotionFormat format = MotionFormat::bvh) {
  SynthOptions options;
  options.takes = 8;
  options.seconds = 9;
  options.subjects = 3;
  options.format = format;
  return options;
}

/// A folder of one test's own, removed at its end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("reprise_synth_") + test->test_suite_name() + test->name();
    std::replace(name.begin(), name.end(), '/', '_');
    path_ = fs::temp_directory_path() / name;
    fs::remove_all(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

bool same_channels(const Take& a, const Take& b) {
  return a.channels.rows() == b.channels.rows() && a.channels.cols() == b.channels.cols() &&
         a.channels == b.channels;
}

bool same_truth(const SynthLibrary& a, const SynthLibrary& b) {
  if (a.truth.size() != b.truth.size()) return false;
  for (std::size_t g = 0; g < a.truth.size(); ++g) {
    if (a.truth[g].size() != b.truth[g].size()) return false;
    for (std::size_t i = 0; i < a.truth[g].size(); ++i) {
      const SynthOccurrence &x = a.truth[g][i], &y = b.truth[g][i];
      if (x.file != y.file || x.start_s != y.start_s || x.end_s != y.end_s || x.speed != y.speed ||
          x.noise != y.noise) {
        return false;
      }
    }
  }
  return true;
}

TEST(SynthLibrary, SameSeedGivesTheSameLibrary) {
  const SynthLibrary a = make_synthetic_library(small_options());
  const SynthLibrary b = make_synthetic_library(small_options());
  ASSERT_EQ(a.takes.size(), 8u);
  for (std::size_t i = 0; i < a.takes.size(); ++i) {
    EXPECT_EQ(a.takes[i].name, b.takes[i].name);
    EXPECT_TRUE(same_channels(a.takes[i], b.takes[i]));
    EXPECT_EQ(a.takes[i].skeleton->source_text, b.takes[i].skeleton->source_text);
  }
  EXPECT_TRUE(same_truth(a, b));
}

TEST(SynthLibrary, OtherSeedGivesAnotherLibrary) {
  SynthOptions options = small_options();
  const SynthLibrary a = make_synthetic_library(options);
  options.seed = 2;
  const SynthLibrary b = make_synthetic_library(options);
  EXPECT_FALSE(same_channels(a.takes[0], b.takes[0]));
  EXPECT_NE(a.takes[0].skeleton->source_text, b.takes[0].skeleton->source_text);
  EXPECT_FALSE(same_truth(a, b));
}

class SynthTruth : public ::testing::TestWithParam<MotionFormat> {};

TEST_P(SynthTruth, IntervalsLieInTheirTakesAndDoNotOverlap) {
  const SynthLibrary library = make_synthetic_library(small_options(GetParam()));
  std::map<std::string, const Take*> takes;
  for (const Take& take : library.takes) takes[take.name] = &take;
  std::map<std::string, std::vector<std::pair<double, double>>> intervals;
  ASSERT_GE(library.truth.size(), 2u);
  for (const auto& group : library.truth) {
    for (const SynthOccurrence& occurrence : group) {
      ASSERT_TRUE(takes.count(occurrence.file)) << occurrence.file;
      EXPECT_GE(occurrence.start_s, 0);
      EXPECT_LT(occurrence.start_s, occurrence.end_s);
      EXPECT_LE(occurrence.end_s, takes[occurrence.file]->seconds());
      intervals[occurrence.file].emplace_back(occurrence.start_s, occurrence.end_s);
    }
  }
  for (auto& [name, list] : intervals) {
    std::sort(list.begin(), list.end());
    for (std::size_t i = 1; i < list.size(); ++i)
      EXPECT_LE(list[i - 1].second, list[i].first) << name;
  }
}

TEST_P(SynthTruth, GroupsStartWithTheMotionItselfAndSpeedsExplainTheLengths) {
  const SynthLibrary library = make_synthetic_library(small_options(GetParam()));
  for (const auto& group : library.truth) {
    ASSERT_GE(group.size(), 2u);
    EXPECT_EQ(group[0].speed, 1);
    EXPECT_EQ(group[0].noise, 0);
    const double length = group[0].end_s - group[0].start_s;
    std::set<std::string> files;
    for (const SynthOccurrence& occurrence : group) {
      EXPECT_NEAR(occurrence.end_s - occurrence.start_s, length / occurrence.speed, 0.05);
      EXPECT_GE(occurrence.speed, 0.5);
      EXPECT_LE(occurrence.speed, 2);
      EXPECT_TRUE(files.insert(occurrence.file).second) << "twice in " << occurrence.file;
    }
  }
}

TEST_P(SynthTruth, WrittenFilesReadBackEqual) {
  const SynthOptions options = small_options(GetParam());
  const bool bvh = GetParam() == MotionFormat::bvh;
  const std::string extension = bvh ? ".bvh" : ".amc";
  const SynthLibrary library = make_synthetic_library(options);
  const TemporaryFolder folder;
  EXPECT_EQ(write_synthetic_library(folder.path(), options, false), 8u + 1u + (bvh ? 0u : 3u));
  for (const Take& take : library.takes) {
    const Take read = read_motion_file(folder.path() / (take.name + extension));
    EXPECT_TRUE(same_channels(read, take)) << take.name;
    EXPECT_EQ(read.frame_rate, take.frame_rate);
    EXPECT_EQ(read.frame_rate_assumed, take.frame_rate_assumed);
    EXPECT_EQ(read.layout.frame_time_text, take.layout.frame_time_text);
    EXPECT_EQ(read.layout.amc_header, take.layout.amc_header);
    EXPECT_EQ(read.layout.amc_joints, take.layout.amc_joints);
    EXPECT_EQ(read.skeleton->source_text, take.skeleton->source_text);
    EXPECT_EQ(read.skeleton->asf_name, take.skeleton->asf_name);
    EXPECT_TRUE(same_structure(*read.skeleton, *take.skeleton));
  }
  std::ifstream file(folder.path() / "truth.json");
  const auto truth = nlohmann::json::parse(file);
  ASSERT_EQ(truth.size(), library.truth.size());
  for (std::size_t g = 0; g < truth.size(); ++g) {
    ASSERT_EQ(truth[g].size(), library.truth[g].size());
    for (std::size_t i = 0; i < truth[g].size(); ++i) {
      const SynthOccurrence& expected = library.truth[g][i];
      EXPECT_EQ(truth[g][i]["file"], expected.file + extension);
      EXPECT_EQ(truth[g][i]["start_s"], expected.start_s);
      EXPECT_EQ(truth[g][i]["end_s"], expected.end_s);
      EXPECT_EQ(truth[g][i]["speed"], expected.speed);
      EXPECT_EQ(truth[g][i]["noise"], expected.noise);
    }
  }
}

TEST_P(SynthTruth, SubjectsDifferInLengthsOnly) {
  const SynthLibrary library = make_synthetic_library(small_options(GetParam()));
  const Skeleton& first = *library.takes[0].skeleton;
  for (std::size_t i = 1; i < 3; ++i) {
    const Skeleton& other = *library.takes[i].skeleton;
    EXPECT_TRUE(same_structure(first, other));
    double difference = 0;
    for (std::size_t j = 0; j < first.joints.size(); ++j) {
      difference +=
          (first.joints[j].offset - other.joints[j].offset).norm() * first.millimetres_per_unit;
    }
    EXPECT_GT(difference, 20) << "mm, summed over the bones";
  }
  EXPECT_EQ(library.takes[3].skeleton, library.takes[0].skeleton) << "takes of a subject share one";
}

INSTANTIATE_TEST_SUITE_P(Formats, SynthTruth,
                         ::testing::Values(MotionFormat::bvh, MotionFormat::asf_amc),
                         [](const auto& format) {
                           return format.param == MotionFormat::bvh ? "Bvh" : "Amc";
                         });

TEST(SynthLibrary, LengthsVaryAroundTheMean) {
  SynthOptions options = small_options();
  options.takes = 24;
  const SynthLibrary library = make_synthetic_library(options);
  double sum = 0, shortest = 1e9, longest = 0;
  for (const Take& take : library.takes) {
    sum += take.seconds();
    shortest = std::min(shortest, take.seconds());
    longest = std::max(longest, take.seconds());
  }
  EXPECT_NEAR(sum / 24, options.seconds, 0.15 * options.seconds);
  EXPECT_GT(longest - shortest, 0.2 * options.seconds);
}

TEST(SynthLibrary, ExistingFilesAreKeptUnlessTold) {
  SynthOptions options = small_options();
  options.takes = 2;
  options.seconds = 2;
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "s01");
  std::ofstream(folder.path() / "s01" / "s01_01.bvh") << "mine";
  try {
    write_synthetic_library(folder.path(), options, false);
    FAIL() << "a file was replaced";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::failed);
  }
  EXPECT_EQ(read_whole_file(folder.path() / "s01" / "s01_01.bvh"), "mine");
  EXPECT_FALSE(fs::exists(folder.path() / "truth.json"));
  EXPECT_EQ(write_synthetic_library(folder.path(), options, true), 3u);
  EXPECT_NE(read_whole_file(folder.path() / "s01" / "s01_01.bvh"), "mine");
}

TEST(SynthLibrary, AFolderThatCannotBeMadeIsAnError) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path());
  std::ofstream(folder.path() / "file") << "in the way";
  EXPECT_THROW(write_synthetic_library(folder.path() / "file", small_options(), false), Error);
}

TEST(SynthLibrary, SmallestLibrariesWork) {
  SynthOptions options;
  options.takes = 1;
  options.seconds = 1;
  options.subjects = 4;
  const SynthLibrary shortest = make_synthetic_library(options);
  ASSERT_EQ(shortest.takes.size(), 1u);
  EXPECT_GT(shortest.takes[0].frames(), 30);
  EXPECT_TRUE(shortest.truth.empty());
  options.seconds = 40;  // one long take repeats itself
  EXPECT_FALSE(make_synthetic_library(options).truth.empty());
}

}  // namespace
}  // namespace reprise
