// Which ASF belongs to an AMC, by their names.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "reprise/error.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

/// The name that is chosen, "" for none, "several" where it is not clear.
std::string chosen(const std::string& amc, const std::vector<std::string>& asf) {
  std::vector<fs::path> paths(asf.begin(), asf.end());
  std::ranges::sort(paths);
  std::string first;
  do {
    std::string name;
    try {
      name = choose_asf(amc, paths).value_or("").string();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::rejected_input);
      EXPECT_NE(error.advice().find("--asf"), std::string::npos);
      name = "several";
    }
    if (first.empty()) first = name;
    EXPECT_EQ(name, first) << "the order decides";
  } while (std::ranges::next_permutation(paths).found);
  return first;
}

TEST(AsfSearch, TheNameBeginsWithIt) {
  EXPECT_EQ(chosen("02_01.amc", {"02.asf", "03.asf"}), "02.asf");
  EXPECT_EQ(chosen("HDM_mm_walk_019_120.amc", {"HDM_bk.asf", "HDM_mm.asf", "HDM_tr.asf"}),
            "HDM_mm.asf");
  EXPECT_EQ(chosen("hdm_MM_walk.AMC", {"HDM_bk.ASF", "HDM_mm.ASF"}), "HDM_mm.ASF");
  EXPECT_EQ(chosen("walk01.amc", {"walk.asf", "run.asf"}), "walk.asf");
  EXPECT_EQ(chosen("anna-2 jump.amc", {"anna.asf", "ann.asf"}), "anna.asf");
}

TEST(AsfSearch, TheLongestName) {
  EXPECT_EQ(chosen("HDM_mm_walk.amc", {"HDM.asf", "HDM_mm.asf"}), "HDM_mm.asf");
  EXPECT_EQ(chosen("02_01.amc", {"02.asf", "02_01.asf"}), "02_01.asf");
}

TEST(AsfSearch, NotWithinAWordOrNumber) {
  EXPECT_EQ(chosen("131_04.amc", {"13.asf", "31.asf"}), "");
  EXPECT_EQ(chosen("walking_01.amc", {"walk.asf", "run.asf"}), "");
}

TEST(AsfSearch, WordsInTheSameOrder) {
  const std::vector<std::string> course = {"07-walk.asf", "09-run.asf", "131-dance.asf"};
  EXPECT_EQ(chosen("07_05-walk.amc", course), "07-walk.asf");
  EXPECT_EQ(chosen("131_04-dance.amc", course), "131-dance.asf");
  EXPECT_EQ(chosen("09_05-walk.amc", course), "");
  EXPECT_EQ(chosen("walk_05-07.amc", course), "");
}

TEST(AsfSearch, TwoThatFitAreNotGuessedBetween) {
  EXPECT_EQ(chosen("07_05-walk.amc", {"07-walk.asf", "07-05.asf"}), "several");
  EXPECT_EQ(chosen("07_05-walk.amc", {"07.asf", "07-walk.asf"}), "several");
  EXPECT_EQ(chosen("walk_1.amc", {"walk.asf", "WALK.asf"}), "several");
}

class AsfFolder : public testing::Test {
 protected:
  AsfFolder() {
    std::string pattern = (fs::temp_directory_path() / "reprise-test-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~AsfFolder() override { fs::remove_all(folder_); }
  void make(const std::string& name) const { std::ofstream(folder_ / name) << "\n"; }

  fs::path folder_;
};

TEST_F(AsfFolder, TheOnlyOneIsTaken) {
  make("any.asf");
  make("._any.asf");
  EXPECT_EQ(find_asf(folder_ / "walk.amc"), folder_ / "any.asf");
  make("other.asf");
  EXPECT_THROW(find_asf(folder_ / "walk.amc"), Error);
  EXPECT_EQ(find_asf(folder_ / "other 2.amc"), folder_ / "other.asf");
}

TEST_F(AsfFolder, WhatIsGivenComesFirst) {
  make("walk.asf");
  ReadOptions options;
  EXPECT_EQ(asf_of(folder_ / "walk.amc", options), folder_ / "walk.asf");
  options.asf = {"x/any.asf"};
  EXPECT_EQ(asf_of(folder_ / "walk.amc", options), "x/any.asf");
  options.asf = {"x/any.asf", "x/02.asf"};
  EXPECT_EQ(asf_of(folder_ / "02_11.amc", options), "x/02.asf");
  EXPECT_THROW(asf_of(folder_ / "walk.amc", options), Error);
}

TEST(FileNames, AnEndingMayBeTheWholeName) {
  EXPECT_EQ(motion_format_of("a/.bvh"), MotionFormat::bvh);
  EXPECT_EQ(motion_format_of(".AMC"), MotionFormat::asf_amc);
  EXPECT_EQ(motion_format_of("bvh"), std::nullopt);
  EXPECT_EQ(motion_format_of(".bvh.txt"), std::nullopt);
  EXPECT_TRUE(is_resource_fork("a/._walk.bvh"));
  EXPECT_FALSE(is_resource_fork("._a/walk.bvh"));
}

}  // namespace
}  // namespace reprise
