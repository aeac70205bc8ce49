// What an ID means: a name, an end of one, a clip; and takes that go by another name than before.
#include "cli/command_runner.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

class IdsTest : public CommandTest {
 protected:
  std::string take_meant_by(const std::string& id) const {
    return document({"info", "lib.rpz", id}).at("take").at("name");
  }
};

TEST_F(IdsTest, AnyTrailingPartThatIsUnambiguousWillDo) {
  make_library();  // s01/s01_01, s01/s01_02, s02/s02_01, s02/s02_02
  EXPECT_EQ(take_meant_by("s01/s01_02"), "s01/s01_02");
  EXPECT_EQ(take_meant_by("s02_01"), "s02/s02_01");
  EXPECT_EQ(take_meant_by("02_01"), "s02/s02_01");
  EXPECT_EQ(take_meant_by("2/s02_01"), "s02/s02_01");
  const Outcome ambiguous = reprise({"info", "lib.rpz", "_02"});
  EXPECT_EQ(ambiguous.exit_code, 7);
  EXPECT_NE(ambiguous.err.find("s01/s01_02, s02/s02_02"), std::string::npos) << ambiguous.err;
  EXPECT_EQ(reprise({"info", "lib.rpz", "s01_"}).exit_code, 7) << "a part in the middle is none";
}

TEST_F(IdsTest, WholeComponentsCountBeforeEndsOfThem) {
  make_library();
  const fs::path source = folder() / "takes/s01/s01_01.bvh";
  fs::create_directory(folder() / "more");
  fs::copy_file(source, folder() / "more/01_01.bvh");
  output({"ingest", "lib.rpz", "more", "--prefix", "more"});
  EXPECT_EQ(take_meant_by("01_01"), "more/01_01");
  EXPECT_EQ(take_meant_by("/s01_01"), "s01/s01_01");
}

TEST_F(IdsTest, AClipOfSeveralTakesIsTakenFromTheMostFaithful) {
  output({"synth", "one", "--takes", "1", "--seconds", "2", "--subjects", "1"});
  output({"ingest", "lib.rpz", "one", "--prefix", "a", "--fidelity", "preview", "--no-repeats"});
  output({"ingest", "lib.rpz", "one", "--prefix", "b", "--fidelity", "exact", "--no-repeats"});
  output({"ingest", "lib.rpz", "one", "--prefix", "c", "--fidelity", "fine", "--no-repeats"});
  const auto clips = document({"list", "lib.rpz", "--clips"}).at("clips");
  ASSERT_EQ(clips.size(), 3U);
  const std::string id = clips[0].at("id");
  EXPECT_EQ(clips[2].at("id"), id);
  EXPECT_EQ(output({"extract", "lib.rpz", id, "--fidelity", "exact", "-o", "-"}),
            read_file(folder() / "one/s01/s01_01.bvh"));
  output({"remove", "lib.rpz", "b/s01/s01_01"});
  EXPECT_EQ(output({"extract", "lib.rpz", id, "-o", "-"}),
            output({"extract", "lib.rpz", "c/s01/s01_01", "-o", "-"}));
  EXPECT_EQ(reprise({"extract", "lib.rpz", id, "--fidelity", "exact", "-o", "-"}).exit_code, 2);
}

// Once the one that is meant is gone, the same words must not mean another one.
TEST_F(IdsTest, RemovingTakesNamesFromASlashOn) {
  make_library();
  output({"remove", "lib.rpz", "s02_01"});
  EXPECT_EQ(reprise({"remove", "lib.rpz", "02_02"}).exit_code, 7);
  EXPECT_EQ(reprise({"remove", "lib.rpz", "s02_01"}).exit_code, 7);
  EXPECT_EQ(take_names().size(), 3U);
}

TEST_F(IdsTest, AnEmptyIdIsWrongUsage) {
  output({"synth", "one", "--takes", "1", "--seconds", "1", "--subjects", "1"});
  output({"ingest", "lib.rpz", "one"});
  EXPECT_EQ(reprise({"remove", "lib.rpz", ""}).exit_code, 2);
  EXPECT_EQ(reprise({"extract", "lib.rpz", "", "-o", "-"}).exit_code, 2);
  EXPECT_EQ(reprise({"ingest", "lib.rpz", ""}).exit_code, 2);
  EXPECT_EQ(take_names().size(), 1U);
}

TEST_F(IdsTest, WhatMayBeAClipOrTheEndOfANameIsAmbiguous) {
  output({"synth", "one", "--takes", "1", "--seconds", "1", "--subjects", "1"});
  output({"ingest", "lib.rpz", "one"});
  const std::string id = document({"list", "lib.rpz", "--clips"}).at("clips")[0].at("id");
  const std::string start = id.substr(0, 5);
  EXPECT_EQ(reprise({"info", "lib.rpz", start}).exit_code, 0);
  fs::rename(folder() / "one/s01/s01_01.bvh", folder() / "one/s01" / ("x" + start + ".bvh"));
  output({"ingest", "lib.rpz", "one"});
  const Outcome outcome = reprise({"info", "lib.rpz", start});
  EXPECT_EQ(outcome.exit_code, 7);
  EXPECT_NE(outcome.err.find(id + ", s01/x" + start), std::string::npos) << outcome.err;
  EXPECT_EQ(reprise({"info", "lib.rpz", id}).exit_code, 0);
}

TEST_F(IdsTest, TwoFilesAreNeverOneStoredTake) {
  output({"synth", "in", "--takes", "1", "--seconds", "2", "--subjects", "1"});
  output({"ingest", "lib.rpz", "in"});
  fs::copy_file(folder() / "in/s01/s01_01.bvh", folder() / "in/s01/s01_01.BVH");
  const auto report = document({"ingest", "lib.rpz", "in", "--replace", "--fidelity", "fine"});
  EXPECT_EQ(report.at("added").size(), 2U) << report;
  EXPECT_EQ(take_names().size(), 2U);
  output({"verify", "lib.rpz"});
}

// What comes to lie beside a file gives it another name; it is stored already all the same.
TEST_F(IdsTest, AFileIsStoredOnceThoughItsNameBecomesAnother) {
  output({"synth", "in", "--takes", "1", "--seconds", "2", "--subjects", "1"});
  output({"synth", "amc", "--takes", "1", "--seconds", "2", "--subjects", "1", "--format", "amc"});
  output({"ingest", "lib.rpz", "in"});
  for (const char* name : {"s01.asf", "s01_01.amc"}) {
    fs::copy_file(folder() / "amc/s01" / name, folder() / "in/s01" / name);
  }
  const auto report = document({"ingest", "lib.rpz", "in"});
  EXPECT_EQ(report.at("skipped"), nlohmann::json::array({"s01/s01_01"}));
  EXPECT_EQ(report.at("added"), nlohmann::json::array({"s01/s01_01.amc"}));
  output({"verify", "lib.rpz", "--against", "in"});

  fs::remove(folder() / "in/s01/s01_01.bvh");
  output({"remove", "lib.rpz", "s01/s01_01"});
  EXPECT_EQ(document({"ingest", "lib.rpz", "in"}).at("skipped"),
            nlohmann::json::array({"s01/s01_01.amc"}));
}

}  // namespace
}  // namespace reprise::cli
