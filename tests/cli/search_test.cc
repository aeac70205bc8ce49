// reprise search, and what info says of bodies.
#include <sstream>

#include "cli/command_runner.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

using nlohmann::json;

class SearchTest : public CommandTest {
 protected:
  SearchTest() { make_library(); }
};

TEST_F(SearchTest, ResultsHaveThePromisedFields) {
  const std::string take = take_names()[0];
  const json results = document({"search", "lib.rpz", "--id", take}).at("results");
  ASSERT_EQ(results.size(), take_names().size() - 1);
  for (const json& result : results) {
    EXPECT_TRUE(result.at("take").is_string());
    EXPECT_NE(result.at("take"), take);
    EXPECT_TRUE(result.at("subject").is_string());
    for (const char* field : {"start", "end", "distance_mm", "unlikeness"}) {
      EXPECT_TRUE(result.at(field).is_number()) << field;
    }
    EXPECT_TRUE(result.at("repeat").is_boolean());
    EXPECT_LT(result.at("start"), result.at("end"));
  }
}

TEST_F(SearchTest, ALinePartsRepeatsFromTheRest) {
  const std::string take = take_names()[1];
  const std::vector<std::string> itself = {"search", "lib.rpz", "--like", "takes/" + take + ".bvh"};
  const json results = document(itself).at("results");
  EXPECT_TRUE(results.at(0).at("repeat").get<bool>());
  ASSERT_FALSE(results.back().at("repeat").get<bool>());
  std::istringstream lines(output(itself));
  std::string line;
  std::getline(lines, line);  // the headings
  for (const json& result : results) {
    std::getline(lines, line);
    if (line.starts_with("---")) {
      EXPECT_FALSE(result.at("repeat").get<bool>());
      std::getline(lines, line);
      break;
    }
    EXPECT_TRUE(result.at("repeat").get<bool>());
    EXPECT_TRUE(line.starts_with(result.at("take").get<std::string>()));
  }
  EXPECT_FALSE(line.empty());
  EXPECT_EQ(reprise(itself).err.find("nothing repeats"), std::string::npos);
}

TEST_F(SearchTest, SaysWhereNothingIsNear) {
  const std::string take = take_names()[0];
  const Outcome outcome = reprise({"search", "lib.rpz", "--id", take});
  const json results = document({"search", "lib.rpz", "--id", take}).at("results");
  const bool near = results.at(0).at("repeat").get<bool>();
  EXPECT_EQ(near, outcome.err.find("nothing repeats the example") == std::string::npos)
      << outcome.err;
}

TEST_F(SearchTest, AFileFindsItsTake) {
  const std::string take = take_names()[1];
  const std::string file = "takes/" + take + ".bvh";
  const json found = document({"search", "lib.rpz", "--like", file, "--top", "1"});
  ASSERT_EQ(found.at("results").size(), 1u);
  EXPECT_EQ(found.at("results")[0].at("take"), take);
  Surroundings piped;
  piped.input = folder() / file;
  const Outcome outcome =
      reprise({"search", "lib.rpz", "--like", "-", "--top", "1", "--json"}, piped);
  EXPECT_EQ(json::parse(outcome.out), found);
}

TEST_F(SearchTest, AClipIsAPartOfItsTake) {
  const json clips = document({"list", "lib.rpz", "--clips"}).at("clips");
  ASSERT_FALSE(clips.empty());
  EXPECT_EQ(reprise({"search", "lib.rpz", "--id", clips[0].at("id")}).exit_code, 0);
}

TEST_F(SearchTest, APartOutsideItsClipOrWithoutLengthIsWrongUsage) {
  const json clips = document({"list", "lib.rpz", "--clips"}).at("clips");
  for (const json& clip : clips) {
    if (clip.at("start") == 0.0) continue;
    const Outcome before =
        reprise({"search", "lib.rpz", "--id", clip.at("id"), "--from", "0", "--to", "0.5"});
    EXPECT_EQ(before.exit_code, 2) << before.err;
  }
  const json take = document({"list", "lib.rpz"}).at("takes").at(0);
  const std::string late = std::to_string(take.at("seconds").get<double>() - 0.02);
  const Outcome nothing = reprise({"search", "lib.rpz", "--id", take.at("id"), "--from", late});
  EXPECT_EQ(nothing.exit_code, 2) << nothing.err;
  EXPECT_NE(nothing.err.find("too short"), std::string::npos) << nothing.err;
}

TEST_F(SearchTest, AWholeTakeEndsWhereItEnds) {
  std::map<std::string, double> seconds;
  const json takes = document({"list", "lib.rpz"}).at("takes");
  for (const json& take : takes) {
    seconds[take.at("name")] = take.at("seconds");
  }
  const std::string take = take_names()[0];
  const json results = document({"search", "lib.rpz", "--id", take}).at("results");
  for (const json& result : results) {
    EXPECT_EQ(result.at("start"), 0.0);
    EXPECT_EQ(result.at("end"), seconds.at(result.at("take")));
  }
}

TEST_F(SearchTest, WithoutTheCacheNothingIsWritten) {
  const std::string take = take_names()[0];
  const auto before = files_below(folder());
  const std::string results = output({"search", "lib.rpz", "--id", take});
  EXPECT_EQ(files_below(folder()).size(), before.size());
  EXPECT_EQ(output({"search", "lib.rpz", "--id", take, "--cache"}), results);
  EXPECT_EQ(files_below(folder()).count("lib.rpz.features"), 1u);
  EXPECT_EQ(output({"search", "lib.rpz", "--id", take}), results);
}

TEST_F(SearchTest, ACacheOfTheSameFilesReadOtherwiseIsNotUsed) {
  const std::vector<std::string> search = {"search", "lib.rpz", "--id", take_names()[0], "--json"};
  std::vector<std::string> keeping = search;
  keeping.emplace_back("--cache");
  output(keeping);
  fs::remove(folder() / "lib.rpz");
  output({"ingest", "lib.rpz", "takes", "--unit-mm", "40", "--fidelity", "preview"});
  const std::string with_cache = output(search);
  fs::remove(folder() / "lib.rpz.features");
  EXPECT_EQ(with_cache, output(search));
}

TEST_F(SearchTest, ACacheThatCannotBeWrittenIsNoHindrance) {
  const std::string take = take_names()[0];
  const std::string results = output({"search", "lib.rpz", "--id", take});
  std::filesystem::create_directories(folder() / "lib.rpz.features" / "full");
  const auto before = files_below(folder());
  const Outcome outcome = reprise({"search", "lib.rpz", "--id", take, "--cache"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, results);
  EXPECT_EQ(outcome.err.rfind("lib.rpz.features: the search cache cannot be written: ", 0), 0U)
      << outcome.err;
  EXPECT_EQ(files_below(folder()), before);
}

TEST_F(SearchTest, NothingToCompareWithIsAnAnswer) {
  write_file(folder() / "box.bvh",
             "HIERARCHY\nROOT Box\n{\n  OFFSET 0 0 0\n  CHANNELS 6 Xposition Yposition Zposition "
             "Zrotation Xrotation Yrotation\n  End Site\n  {\n    OFFSET 0 10 0\n  }\n}\nMOTION\n"
             "Frames: 2\nFrame Time: 0.01\n0 0 0 0 0 0\n1 0 0 0 0 0\n");
  const std::vector<std::string> by_file = {"search", "lib.rpz", "--like", "box.bvh"};
  EXPECT_EQ(document(by_file).at("results").size(), 0u);
  EXPECT_NE(reprise(by_file).err.find("--joint-map"), std::string::npos);
  output({"ingest", "lib.rpz", "box.bvh"});
  EXPECT_EQ(document({"search", "lib.rpz", "--id", "box"}).at("results").size(), 0u);
}

TEST_F(SearchTest, ErrorsHaveTheirCodes) {
  const std::string take = take_names()[0];
  const std::string file = "takes/" + take + ".bvh";
  EXPECT_EQ(reprise({"search", "lib.rpz"}).exit_code, 2);
  EXPECT_EQ(reprise({"search", "lib.rpz", "--id", take, "--like", file}).exit_code, 2);
  EXPECT_EQ(reprise({"search", "lib.rpz", "--like", file, "--across-subjects"}).exit_code, 2);
  EXPECT_EQ(reprise({"search", "lib.rpz", "--id", take, "--from", "2", "--to", "1"}).exit_code, 2);
  EXPECT_EQ(reprise({"search", "lib.rpz", "--id", take, "--to", "9999"}).exit_code, 2);
  EXPECT_EQ(reprise({"search", "lib.rpz", "--id", "no-such-take"}).exit_code, 7);
  EXPECT_NE(reprise({"search", "lib.rpz", "--like", "nothing.bvh"}).exit_code, 0);
  EXPECT_EQ(reprise({"search", "nowhere.rpz", "--id", take}).exit_code, 1);
  EXPECT_EQ(reprise({"search", "lib.rpz", "--id", take, "--unit-mm", "10"}).exit_code, 2);
  EXPECT_EQ(reprise({"search", "lib.rpz", "--like", file, "--to", "0.001"}).exit_code, 2);
}

TEST_F(SearchTest, ALimitThatLeavesNothingIsBlamedItself) {
  const std::string take = take_names()[0];
  const Outcome none = reprise({"search", "lib.rpz", "--id", take, "--limit-mm", "0"});
  EXPECT_EQ(none.exit_code, 0);
  EXPECT_NE(none.err.find("no take is within 0 mm"), std::string::npos) << none.err;
}

TEST_F(SearchTest, InfoShowsTheBodyAndAMapCorrectsIt) {
  const std::string take = take_names()[0];
  const json info = document({"info", "lib.rpz", take}).at("take");
  EXPECT_EQ(info.at("body").at("knee_left"), "LeftLeg");
  EXPECT_EQ(info.at("body").size(), 17u);
  EXPECT_EQ(info.at("key_poses").size(), 8u);
  write_file(folder() / "map.txt", "knee_left = RightFoot\nhead =\n");
  const json corrected =
      document({"info", "lib.rpz", take, "--joint-map", "map.txt"}).at("take").at("body");
  EXPECT_EQ(corrected.at("knee_left"), "RightFoot");
  EXPECT_EQ(corrected.at("head"), "");
  Surroundings piped;
  piped.input = "map.txt";
  const Outcome from_stdin =
      reprise({"info", "lib.rpz", take, "--joint-map", "-", "--json"}, piped);
  EXPECT_EQ(json::parse(from_stdin.out).at("take").at("body"), corrected);
  EXPECT_EQ(reprise({"search", "lib.rpz", "--like", "-", "--joint-map", "-"}).exit_code, 2);
  write_file(folder() / "map.txt", "tail = Tail\n");
  EXPECT_EQ(reprise({"search", "lib.rpz", "--id", take, "--joint-map", "map.txt"}).exit_code, 1);
}

}  // namespace
}  // namespace reprise::cli
