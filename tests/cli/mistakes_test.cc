// Mistakes of everyday use: what they must never destroy, and that each is told once and clearly.
#include <algorithm>

#include "cli/command_runner.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

class MistakesTest : public CommandTest {};

TEST_F(MistakesTest, AdviceIsGivenOnce) {
  const std::string said = reprise({"list"}).err;
  const std::string advice = "see reprise list --help";
  const std::size_t at = said.find(advice);
  ASSERT_NE(at, std::string::npos) << said;
  EXPECT_EQ(said.find(advice, at + 1), std::string::npos) << said;
}

TEST_F(MistakesTest, AnArchiveIsNeverReplacedByWhatComesOutOfIt) {
  make_library();
  const std::string archive = read_file(folder() / "lib.rpz");
  const std::string take = take_names().front();
  fs::create_hard_link(folder() / "lib.rpz", folder() / "other.bvh");
  for (const char* file : {"lib.rpz", "./lib.rpz", "other.bvh"}) {
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"extract", "lib.rpz", take},
          std::vector<std::string>{"plot", "lib.rpz", "--summary", take}}) {
      std::vector<std::string> words = command;
      words.insert(words.end(), {"-o", file, "--overwrite"});
      const Outcome outcome = reprise(words);
      EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
      EXPECT_NE(outcome.err.find("the archive itself"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(read_file(folder() / file), archive);
  }
}

TEST_F(MistakesTest, AFolderOrADeviceInPlaceOfAFileIsCalledWhatItIs) {
  make_library();
  const std::string take = take_names().front();
  EXPECT_NE(reprise({"extract", "lib.rpz", take, "-o", "takes"}).err.find("folder"),
            std::string::npos);
  const Outcome device = reprise({"extract", "lib.rpz", take, "-o", "/dev/null"});
  EXPECT_EQ(device.exit_code, 1);
  EXPECT_EQ(device.err.find("--overwrite"), std::string::npos) << device.err;
}

TEST_F(MistakesTest, WhatIsNotThereIsSaidInItsOwnWords) {
  make_library();
  const std::string take = take_names().front();
  EXPECT_NE(reprise({"info", "lib.rpz", "no-such-take"}).err.find("reprise list"),
            std::string::npos);
  EXPECT_NE(reprise({"search", "lib.rpz", "--like", "nowhere"}).err.find("no such file"),
            std::string::npos);
  EXPECT_NE(
      reprise({"extract", "lib.rpz", take, "-d", "lib.rpz"}).err.find("folder cannot be made"),
      std::string::npos);
  const std::string late = reprise({"repeats", "lib.rpz", take, "--to", "1000"}).err;
  EXPECT_NE(late.find(":1000 s are not within 0:"), std::string::npos) << late;
}

TEST_F(MistakesTest, APartThatIsNotThereIsWrongUsage) {
  make_library();
  const std::string take = take_names().front();
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"search", "lib.rpz", "--id", take, "--to", "1000"},
        {"search", "lib.rpz", "--like", "takes/" + take + ".bvh", "--to", "1000"},
        {"repeats", "lib.rpz", take, "--to", "1000"},
        {"repeats", "lib.rpz", take, "--from", "1000"},
        {"extract", "lib.rpz", take, "-o", "-", "--time", "0:1000"},
        {"extract", "lib.rpz", take, "-o", "-", "--frames", "0:1000000"}}) {
    const Outcome outcome = reprise(words);
    EXPECT_EQ(outcome.exit_code, 2) << words.front() << ": " << outcome.err;
    EXPECT_NE(outcome.err.find("1000"), std::string::npos) << outcome.err;
  }
}

TEST_F(MistakesTest, AClipIsNotRemoved) {
  make_library();
  const auto clip = document({"list", "lib.rpz", "--clips"}).at("clips").at(0);
  const Outcome outcome = reprise({"remove", "lib.rpz", clip.at("id")});
  EXPECT_EQ(outcome.exit_code, 7);
  EXPECT_NE(outcome.err.find("is a clip"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(clip.at("take")), std::string::npos) << outcome.err;
  EXPECT_EQ(take_names().size(), 4U);
}

TEST_F(MistakesTest, ANameWithoutTheExtensionsThatTellTakesApartIsAmbiguous) {
  output({"synth", "both", "--takes", "1", "--seconds", "2", "--subjects", "1"});
  output({"synth", "amc", "--takes", "1", "--seconds", "2", "--subjects", "1", "--format", "amc"});
  for (const char* name : {"s01.asf", "s01_01.amc"}) {
    fs::copy_file(folder() / "amc/s01" / name, folder() / "both/s01" / name);
  }
  output({"ingest", "both.rpz", "both"});
  EXPECT_EQ(take_names("both.rpz"), (std::vector<std::string>{"s01/s01_01.amc", "s01/s01_01.bvh"}));
  const Outcome outcome = reprise({"info", "both.rpz", "s01_01"});
  EXPECT_EQ(outcome.exit_code, 7);
  EXPECT_NE(outcome.err.find("ambiguous: s01/s01_01.amc, s01/s01_01.bvh"), std::string::npos)
      << outcome.err;
  output({"remove", "both.rpz", "s01_01.amc"});
  EXPECT_NE(output({"info", "both.rpz", "s01_01"}).find("s01/s01_01.bvh"), std::string::npos);
}

TEST_F(MistakesTest, AnArchiveAmongTheInputsIsCalledOne) {
  make_library();
  const nlohmann::json report = document({"ingest", "new.rpz", "lib.rpz"}, 3);
  ASSERT_EQ(report.at("rejected").size(), 1U);
  EXPECT_EQ(report.at("rejected")[0].at("path"), "lib.rpz");
  EXPECT_EQ(
      report.at("rejected")[0].at("why").get<std::string>().rfind("this is a Reprise archive", 0),
      0U);
}

TEST_F(MistakesTest, AFileOfAnotherNameIsNotTakenForABvh) {
  make_library();
  fs::copy_file(folder() / "takes" / (take_names().front() + ".bvh"), folder() / "walk.txt");
  const Outcome outcome = reprise({"ingest", "lib.rpz", "walk.txt"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("walk.txt: the name ends neither in .bvh nor in .amc"),
            std::string::npos)
      << outcome.err;
}

TEST_F(MistakesTest, SkeletonsAmongTheFilesAreNoMistake) {
  ASSERT_EQ(reprise({"synth", "amc", "--takes", "1", "--seconds", "1", "--subjects", "1",
                     "--format", "amc"})
                .exit_code,
            0);
  const Outcome outcome = reprise(
      {"ingest", "amc.rpz", "amc/s01/s01.asf", "amc/s01/s01_01.amc", "--fidelity", "exact"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_F(MistakesTest, WhatIsWrongWithASourceIsNoDamageOfTheArchive) {
  make_library();
  const std::string take = take_names().front();
  write_file(folder() / "takes" / (take + ".bvh"), "junk\n");
  const nlohmann::json report = document({"verify", "lib.rpz", "--against", "takes"}, 1);
  ASSERT_EQ(report.at("damaged").size(), 1U);
  EXPECT_NE(report.at("damaged")[0].at("why").get<std::string>().find(take + ".bvh:1: "),
            std::string::npos);
  for (const char* source : {"nowhere", "lib.rpz"}) {
    const Outcome outcome = reprise({"verify", "lib.rpz", "--against", source});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.err.rfind(std::string("reprise: ") + source + ": ", 0), 0U) << outcome.err;
    EXPECT_NE(outcome.err.find("folder"), std::string::npos) << outcome.err;
  }
}

TEST_F(MistakesTest, WhatAnIngestLeavesOutIsTold) {
  output({"synth", "one", "--takes", "1", "--seconds", "2", "--subjects", "1"});
  output({"ingest", "lib.rpz", "one", "--fidelity", "preview"});
  const Outcome again = reprise({"ingest", "lib.rpz", "one"});
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.err.find("1 take stored with another fidelity"), std::string::npos) << again.err;
  EXPECT_NE(again.err.find("--replace"), std::string::npos) << again.err;
  EXPECT_EQ(document({"ingest", "lib.rpz", "one"}).at("other_fidelity").size(), 1U);
  EXPECT_EQ(reprise({"ingest", "lib.rpz", "one", "--fidelity", "preview"}).err,
            "1 file of other kinds: 1 .json\n");

  fs::create_directory(folder() / "empty");
  EXPECT_NE(reprise({"ingest", "lib.rpz", "empty"}).err.find("no BVH or AMC"), std::string::npos);
  fs::create_symlink("nowhere.bvh", folder() / "empty" / "lost.bvh");
  const Outcome lost = reprise({"ingest", "lib.rpz", "empty"});
  EXPECT_EQ(lost.exit_code, 3);
  EXPECT_EQ(lost.err.rfind("empty/lost.bvh: ", 0), 0U) << lost.err;
}

TEST_F(MistakesTest, AnIngestThatMakesNoArchiveIsNoSuccess) {
  fs::create_directory(folder() / "empty");
  const Outcome outcome = reprise({"ingest", "new.rpz", "empty"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("no archive was made"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder() / "new.rpz"));
  EXPECT_EQ(reprise({"ingest", "new.rpz", "empty", "--dry-run"}).exit_code, 0);
}

TEST_F(MistakesTest, NothingMeasuredIsNoErrorOfZero) {
  make_library();
  fs::create_directory(folder() / "empty");
  EXPECT_TRUE(document({"verify", "lib.rpz", "--against", "empty"}, 1).at("error_mm").is_null());
  EXPECT_GT(document({"verify", "lib.rpz", "--against", "takes"}).at("error_mm").at("max"), 0.0);
  const Outcome outcome = reprise({"verify", "lib.rpz", "--against", "empty"});
  EXPECT_EQ(outcome.err.rfind("reprise: lib.rpz: some takes", 0), 0U) << outcome.err;
}

TEST_F(MistakesTest, TwoFilesOfOneNameDoNotChangeIt) {
  output({"synth", "a", "--takes", "1", "--seconds", "2", "--subjects", "1"});
  output({"synth", "b", "--takes", "1", "--seconds", "2", "--subjects", "1", "--seed", "2"});
  const nlohmann::json report =
      document({"ingest", "lib.rpz", "a", "b", "--fidelity", "preview"}, 3);
  ASSERT_EQ(report.at("added").size(), 1U);
  EXPECT_EQ(report.at("added")[0], "s01/s01_01");
  EXPECT_EQ(report.at("rejected").size(), 1U);
}

TEST_F(MistakesTest, AWrongFileForAnArgumentIsNamedBeforeAnythingIsStored) {
  output({"synth", "one", "--takes", "1", "--seconds", "2", "--subjects", "1"});
  const auto refused = [&](const std::vector<std::string>& words, int code, const char* said) {
    const Outcome outcome = reprise(words);
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  };
  refused({"ingest", "lib.rpz", "one", "--asf", "none.asf"}, 1, "none.asf: ");
  refused({"ingest", "lib.rpz", "one", "--metadata", "none.csv"}, 1, "none.csv: ");
  refused({"ingest", "none/lib.rpz", "one"}, 1, "No such file");
  refused({"ingest", "one", "one"}, 4, "this is a folder");
  refused({"list", "one"}, 4, "this is a folder");
  refused({"ingest", "one/s01/s01_01.bvh", "one"}, 4, "not a Reprise archive");
  refused({"info", "lib.rpz", ""}, 2, "ID takes a text");
  refused({"repeats", "lib.rpz", ""}, 2, "ID takes a text");
  refused({"list", "lib.rpz", "--take", ""}, 2, "--take takes a text");
  EXPECT_FALSE(fs::exists(folder() / "lib.rpz"));
}

}  // namespace
}  // namespace reprise::cli
