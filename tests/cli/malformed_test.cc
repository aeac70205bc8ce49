// Bad files among good ones: each named with its line, and the good ones stored.
#include <algorithm>

#include "cli/command_runner.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

class MalformedTest : public CommandTest {};

bool is_motion(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return extension == ".bvh" || extension == ".amc";
}

TEST_F(MalformedTest, EachBadFileIsNamedAndTheGoodOnesAreStored) {
  const fs::path source = REPRISE_MALFORMED_DIR;
  ASSERT_TRUE(fs::exists(source)) << source;
  output({"synth", "mixed/good", "--takes", "3", "--seconds", "2"});
  fs::copy(source, folder() / "mixed/bad", fs::copy_options::recursive);
  std::size_t bad = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder() / "mixed/bad")) {
    if (entry.is_regular_file() && is_motion(entry.path())) ++bad;
  }
  ASSERT_GE(bad, 1U);

  const auto report = document({"ingest", "lib.rpz", "mixed"}, 3);
  EXPECT_EQ(report.at("added").size(), 3U) << report.at("added");
  EXPECT_EQ(report.at("rejected").size(), bad);
  for (const auto& rejected : report.at("rejected")) {
    EXPECT_GT(rejected.at("line").get<long>(), 0) << rejected;
    EXPECT_NE(rejected.at("advice"), "") << rejected;
    EXPECT_EQ(rejected.at("why").get<std::string>().find('\n'), std::string::npos) << rejected;
  }
  output({"verify", "lib.rpz"});
}

TEST_F(MalformedTest, OneLineOnStderrForEach) {
  const fs::path source = REPRISE_MALFORMED_DIR;
  ASSERT_TRUE(fs::exists(source)) << source;
  output({"synth", "mixed/good", "--takes", "2", "--seconds", "2"});
  fs::copy(source, folder() / "mixed/bad", fs::copy_options::recursive);
  const Outcome outcome = reprise({"ingest", "lib.rpz", "mixed", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.out, "");
  for (const auto& entry : fs::recursive_directory_iterator(folder() / "mixed/bad")) {
    if (!entry.is_regular_file() || !is_motion(entry.path())) continue;
    const std::string start = entry.path().lexically_relative(folder()).string();
    const auto lines = lines_of(outcome.err);
    const auto count = std::count_if(lines.begin(), lines.end(), [&](const std::string& line) {
      return line.starts_with(start + ":");
    });
    // An AMC may be rejected for its ASF, which is then the file that is named.
    const bool by_asf = count == 0 && entry.path().extension() == ".amc";
    EXPECT_TRUE(count == 1 || by_asf) << start << "\n" << outcome.err;
  }
}

TEST_F(MalformedTest, EachAmcOfABadSkeletonIsNamed) {
  output({"synth", "amc", "--takes", "2", "--seconds", "1", "--subjects", "1", "--format", "amc"});
  write_file(folder() / "amc/s01/s01.asf", ":version 1.10\n:root\norder TX\naxis nonsense\n");
  const auto rejected = document({"ingest", "lib.rpz", "amc"}, 3).at("rejected");
  ASSERT_EQ(rejected.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(rejected[i].at("path"), "amc/s01/s01.asf");
    EXPECT_GT(rejected[i].at("line").get<long>(), 0);
    const std::string take = "s01_0" + std::to_string(i + 1) + ".amc";
    EXPECT_NE(rejected[i].at("why").get<std::string>().find(take), std::string::npos) << rejected;
  }
}

// Axes of all that it has would take hours, and more memory than there is.
TEST_F(MalformedTest, ASkeletonOfVeryManyJointsHoldsNobodyUp) {
  constexpr int joints = 1500;
  std::string text =
      "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n";
  std::string frame = "1 2 3";
  for (int j = 0; j < joints; ++j) {
    text.append("JOINT j").append(std::to_string(j));
    text += "\n{\nOFFSET 1 2 3\nCHANNELS 3 Zrotation Xrotation Yrotation\n}\n";
    frame += " 4 5 6";
  }
  text += "}\nMOTION\nFrames: 2\nFrame Time: 0.01\n" + frame + "\n" + frame + "\n";
  output({"synth", "in", "--takes", "1", "--seconds", "1", "--subjects", "1"});
  write_file(folder() / "in/many.bvh", text);
  output({"ingest", "lib.rpz", "in"});
  output({"verify", "lib.rpz", "--against", "in"});
  EXPECT_EQ(take_names().size(), 2U);
}

TEST_F(MalformedTest, CountsAndTimesThatAreNoneAreQuoted) {
  const auto why_of = [&](const std::string& frames, const std::string& time) {
    write_file(folder() / "in/a.bvh",
               "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xposition\n}\nMOTION\nFrames: " +
                   frames + "\nFrame Time: " + time + "\n1\n");
    return reprise({"ingest", "lib.rpz", "in"}).err;
  };
  fs::create_directory(folder() / "in");
  EXPECT_EQ(why_of("-5", "0.01").rfind("in/a.bvh:8: 'Frames:' is followed by '-5'", 0), 0U)
      << why_of("-5", "0.01");
  EXPECT_EQ(why_of("1", "-1").rfind("in/a.bvh:9: 'Frame Time:' is followed by '-1'", 0), 0U)
      << why_of("1", "-1");
}

}  // namespace
}  // namespace reprise::cli
