// Files as people have them: what an ingest takes, what it passes over, and what it says of each.
#include <algorithm>

#include "cli/command_runner.h"
#include "formats/samples.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

class InputsTest : public CommandTest {
 protected:
  void write(const std::string& name, const std::string& text) const {
    write_file(folder() / name, text);
  }
  bool exists(const std::string& name) const { return fs::exists(folder() / name); }
};

/// A chain of three joints that swings; `rows` frames where `claimed` are said to be.
std::string swing(long claimed, int rows, const std::string& frame_time = "0.02") {
  std::string text =
      "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zrotation\nJOINT b\n{\n"
      "OFFSET 0 30 0\nCHANNELS 1 Zrotation\nEnd Site\n{\nOFFSET 0 20 0\n}\n}\n}\nMOTION\nFrames: " +
      std::to_string(claimed) + "\nFrame Time: " + frame_time + "\n";
  for (int f = 0; f < rows; ++f) {
    text += std::to_string(f % 7) + ".25 90 " + std::to_string(f * 3 % 40) + " " +
            std::to_string(f * 5 % 30) + ".5\n";
  }
  return text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST_F(InputsTest, ACountOfFramesThatIsTooSmallIsTold) {
  write("in/none.bvh", swing(0, 20));
  write("in/less.bvh", swing(19, 20));
  write("in/right.bvh", swing(20, 20));
  for (const char* fidelity : {"standard", "exact"}) {
    const std::string archive = std::string(fidelity) + ".rpz";
    const auto report = document({"ingest", archive, "in", "--fidelity", fidelity});
    EXPECT_EQ(report.at("added").size(), 3U);
    ASSERT_EQ(report.at("notes").size(), 2U);
    EXPECT_EQ(report.at("notes")[0].at("path"), "in/less.bvh");
    EXPECT_EQ(report.at("notes")[0].at("line"), 17);
    EXPECT_EQ(report.at("notes")[0].at("what"),
              "'Frames:' says 19; the 20 that are there were taken");
    for (const char* name : {"none", "less", "right"}) {
      EXPECT_EQ(document({"info", archive, name}).at("take").at("frames"), 20);
    }
    output({"verify", archive, "--against", "in"});
    EXPECT_EQ(document({"ingest", archive, "in"}).at("notes").size(), 0U);
  }
  EXPECT_EQ(output({"extract", "exact.rpz", "none", "-o", "-"}), swing(0, 20));
  EXPECT_NE(output({"extract", "standard.rpz", "none", "-o", "-"}).find("Frames: 20\n"),
            std::string::npos);
}

TEST_F(InputsTest, ARecordingThatWasCutOffIsTakenOnlyInPart) {
  write("in/fewer.bvh", swing(50, 20));
  write("in/row.bvh", swing(21, 20) + "5 90 1");
  const auto rejected = document({"ingest", "lib.rpz", "in"}, 3).at("rejected");
  ASSERT_EQ(rejected.size(), 2U);
  for (const auto& input : rejected) {
    EXPECT_NE(input.at("advice").get<std::string>().find("--partial"), std::string::npos) << input;
  }
  EXPECT_FALSE(exists("lib.rpz"));
  const auto report = document({"ingest", "lib.rpz", "in", "--partial", "--fidelity", "exact"});
  EXPECT_EQ(report.at("added").size(), 2U);
  EXPECT_EQ(report.at("notes").size(), 3U);  // of the row, that it was left out
  for (const char* name : {"fewer", "row"}) {
    EXPECT_EQ(document({"info", "lib.rpz", name}).at("take").at("frames"), 20);
    EXPECT_EQ(output({"extract", "lib.rpz", name, "-o", "-"}),
              read_file(folder() / "in" / (std::string(name) + ".bvh")));
  }
  output({"verify", "lib.rpz", "--against", "in"});
  EXPECT_EQ(reprise({"compare", "in/row.bvh", "in/row.bvh"}).exit_code, 1);
  EXPECT_EQ(document({"compare", "in/row.bvh", "in/row.bvh", "--partial"}).at("frames"), 20);
}

TEST_F(InputsTest, AGivenRateIsRecordedAndComesOut) {
  for (const char* said : {"0.0416667", "33.3", "0"}) {
    fs::remove_all(folder() / "in");
    fs::remove(folder() / "lib.rpz");
    write("in/slow.bvh", swing(24, 24, said));
    output({"ingest", "lib.rpz", "in", "--fps", "120"});
    const auto take = document({"info", "lib.rpz", "slow"}).at("take");
    EXPECT_EQ(take.at("frame_rate"), 120.0);
    EXPECT_EQ(take.at("frame_rate_assumed"), false);
    EXPECT_NEAR(take.at("seconds").get<double>(), 0.2, 1e-12);
    write("out.bvh", output({"extract", "lib.rpz", "slow", "-o", "-"}));
    EXPECT_NE(read_file(folder() / "out.bvh").find("Frame Time: 0.00833333"), std::string::npos);
    output({"verify", "lib.rpz", "--against", "in"});
    output({"verify", "lib.rpz", "--against", "in", "--fps", "120"});
    // The same rate again is nothing new, another one is told.
    EXPECT_EQ(reprise({"ingest", "lib.rpz", "in", "--fps", "120"}).err, "");
    EXPECT_EQ(document({"ingest", "lib.rpz", "in", "--fps", "60"}).at("other_reading").size(), 1U);
    output({"ingest", "lib.rpz", "in", "--fps", "60", "--replace"});
    EXPECT_EQ(document({"info", "lib.rpz", "slow"}).at("take").at("frame_rate"), 60.0);
  }
}

TEST_F(InputsTest, ExactKeepsTheFrameTimeThatAFileSays) {
  write("in/slow.bvh", swing(24, 24, "33.3"));
  output({"ingest", "lib.rpz", "in", "--fps", "120", "--fidelity", "exact"});
  EXPECT_EQ(output({"extract", "lib.rpz", "slow", "-o", "-"}), swing(24, 24, "33.3"));
  EXPECT_NE(output({"extract", "lib.rpz", "slow", "-o", "-", "--frames", "2:9"})
                .find("Frame Time: 0.00833333"),
            std::string::npos);
  output({"verify", "lib.rpz", "--against", "in"});
}

TEST_F(InputsTest, RejectionsHaveAdvice) {
  const std::string good = swing(3, 3);
  write("in/comma.bvh", replaced(good, "1.25", "1,25"));
  write("in/glued.bvh", replaced(good, "1.25 90", "1.25-90"));
  write("in/roots.bvh", replaced(good, "MOTION", "ROOT c\n{\n}\nMOTION"));
  write("in/scale.bvh", replaced(good, "CHANNELS 1 Zrotation", "CHANNELS 2 Zrotation Xscale"));
  write("in/time.bvh", swing(3, 3, "20"));
  write("in/nothing.bvh", swing(0, 0));
  write("in/alone.amc", plain_amc());
  const auto rejected = document({"ingest", "lib.rpz", "in"}, 3).at("rejected");
  ASSERT_EQ(rejected.size(), 7U);
  const Outcome told = reprise({"ingest", "lib.rpz", "in"});
  for (const auto& input : rejected) {
    const std::string why = input.at("why"), advice = input.at("advice"), path = input.at("path");
    EXPECT_NE(advice, "") << input;
    EXPECT_EQ(why.find(advice), std::string::npos) << input;
    const std::string place =
        input.at("line") > 0 ? path + ":" + std::to_string(input.at("line").get<int>()) : path;
    EXPECT_NE(told.err.find(place + ": " + why + "; " + advice + "\n"), std::string::npos)
        << told.err;
  }
}

TEST_F(InputsTest, OtherKindsAreCountedAndMacsCompanionsPassedOver) {
  write("in/a.bvh", swing(3, 3));
  write("in/._a.bvh", std::string("\0\5\x16\7", 4));
  write("in/._x.fbx", "x");
  write("in/.DS_Store", "x");
  write("in/.git/objects/ab", "x");
  write("in/1.fbx", "x");
  write("in/deep/2.FBX", "x");
  write("in/3.c3d", "x");
  write("in/README", "x");
  write("in/.bvh", swing(3, 3, "0.04"));
  write("in/a.asf", plain_asf());
  const Outcome outcome = reprise({"ingest", "lib.rpz", "in", "--unit-mm", "10"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err,
            "5 files of other kinds: 2 .fbx, 1 without an ending, 1 named just .bvh, 1 .c3d\n");
  EXPECT_EQ(take_names(), std::vector<std::string>{"a"});
  const auto report = document({"ingest", "lib.rpz", "in/.bvh", "in"});
  EXPECT_EQ(report.at("added"), nlohmann::json::array({".bvh"}));
  EXPECT_EQ(report.at("other_kinds"),
            (nlohmann::json{{".fbx", 2}, {".c3d", 1}, {"", 1}, {".bvh", 1}}));
  output({"extract", "lib.rpz", ".bvh", "-d", "out"});
  EXPECT_TRUE(exists("out/.bvh"));
  output({"verify", "lib.rpz", "--against", "in"});
}

TEST_F(InputsTest, WhatIsStoredUnderAnotherNameIsTold) {
  write("one/x.bvh", swing(30, 30));
  write("two/y.bvh", swing(30, 30));
  write("two/z.bvh", swing(30, 30, "0.04"));
  output({"ingest", "lib.rpz", "one"});
  const Outcome outcome = reprise({"ingest", "lib.rpz", "two", "--dry-run", "--unit-mm", "10"});
  EXPECT_EQ(outcome.err, "y: the same as x\n");
  const auto report = document({"ingest", "lib.rpz", "two"});
  EXPECT_EQ(report.at("added").size(), 2U);
  EXPECT_EQ(report.at("same_source"), nlohmann::json::array({{{"name", "y"}, {"same_as", "x"}}}));
  // Two that come together.
  const auto both = document({"ingest", "new.rpz", "one", "two"});
  EXPECT_EQ(both.at("same_source"), nlohmann::json::array({{{"name", "y"}, {"same_as", "x"}}}));
  EXPECT_EQ(document({"ingest", "new.rpz", "one", "two"}).at("same_source").size(), 0U);
}

TEST_F(InputsTest, ManyOfOneContentAreTenLines) {
  for (int i = 0; i < 13; ++i) write("in/take" + std::to_string(i) + ".bvh", swing(3, 3));
  const Outcome outcome = reprise({"ingest", "lib.rpz", "in", "--dry-run", "--unit-mm", "10"});
  EXPECT_EQ(lines_of(outcome.err).size(), 11U) << outcome.err;
  EXPECT_NE(outcome.err.find("2 takes more that are the same"), std::string::npos) << outcome.err;
}

TEST_F(InputsTest, WhatIsReplacedIsToldApart) {
  write("in/a.bvh", swing(30, 30));
  write("in/b.bvh", swing(40, 40));
  output({"ingest", "lib.rpz", "in"});
  const Outcome nothing = reprise({"ingest", "lib.rpz", "in", "--replace"});
  EXPECT_NE(nothing.err.find("--replace replaced nothing"), std::string::npos) << nothing.err;
  write("in/b.bvh", swing(41, 41));
  write("in/c.bvh", swing(42, 42));
  const Outcome dry =
      reprise({"ingest", "lib.rpz", "in", "--replace", "--dry-run", "--unit-mm", "10"});
  EXPECT_EQ(dry.err, "");
  const auto report = document({"ingest", "lib.rpz", "in", "--replace"});
  EXPECT_EQ(report.at("added"), (nlohmann::json{"b", "c"}));
  EXPECT_EQ(report.at("replaced"), (nlohmann::json{"b"}));
  write("in/b.bvh", swing(44, 44));
  const std::string text = output({"ingest", "lib.rpz", "in", "--replace"});
  EXPECT_EQ(text.rfind("added     0 takes in ", 0), 0U) << text;
  EXPECT_NE(text.find("\nreplaced  1 take\n"), std::string::npos) << text;
}

TEST_F(InputsTest, ADryRunNamesAndEstimates) {
  output({"synth", "takes", "--takes", "12", "--seconds", "3"});
  const std::string text = output({"ingest", "lib.rpz", "takes", "--dry-run"});
  EXPECT_EQ(text.rfind("would add  12 takes\n  s01/s01_01\n", 0), 0U) << text;
  EXPECT_NE(text.find("\nestimate "), std::string::npos) << text;
  EXPECT_FALSE(exists("lib.rpz"));
  const auto dry = document({"ingest", "lib.rpz", "takes", "--dry-run"});
  EXPECT_EQ(dry.at("added").size(), 12U);
  EXPECT_GT(dry.at("estimate").at("seconds"), 0.0);
  EXPECT_LE(dry.at("estimate").at("sampled"), 12);
  const auto done = document({"ingest", "lib.rpz", "takes"});
  const double bytes = done.at("stats").at("archive_bytes");
  EXPECT_NEAR(dry.at("estimate").at("bytes").get<double>() / bytes, 1, 0.5);
  EXPECT_TRUE(document({"ingest", "lib.rpz", "takes", "--dry-run"}).at("estimate").is_null());
  // Without a folder for temporary files there is no estimate, and that is all.
  const Outcome closed =
      reprise({"ingest", "new.rpz", "takes", "--dry-run"}, {{{"TMPDIR", "nowhere"}}, {}});
  EXPECT_EQ(closed.exit_code, 0) << closed.err;
  EXPECT_EQ(closed.out.find("estimate"), std::string::npos) << closed.out;
  for (const auto& [file, text] : files_below(folder())) {
    EXPECT_EQ(file.find("reprise-sample"), std::string::npos) << file;
  }
}

TEST_F(InputsTest, AQuietVerifySaysNothingWhereAllIsRight) {
  make_library();
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--against", "takes"}}) {
    std::vector<std::string> words = {"verify", "lib.rpz", "-q"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = reprise(words);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out + outcome.err, "");
  }
  fs::remove_all(folder() / "takes/s01");
  const Outcome wrong = reprise({"verify", "lib.rpz", "-q", "--against", "takes"});
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_NE(wrong.out.find("its source is not in the folder"), std::string::npos);
}

TEST_F(InputsTest, EachAmcHasTheSkeletonOfItsName) {
  const std::string other = replaced(plain_asf(), "length 7.5", "length 9.5");
  write("in/HDM_mm.asf", plain_asf());
  write("in/HDM_tr.asf", other);
  write("in/HDM_mm_walk_019_120.amc", plain_amc());
  write("in/HDM_tr_walk_027_120.amc", plain_amc());
  write("apart/HDM_tr_run_120.amc", plain_amc());
  write("apart/any.amc", plain_amc());
  const auto report = document({"ingest", "lib.rpz", "in", "--fidelity", "exact"});
  EXPECT_EQ(report.at("added").size(), 2U) << report.dump(1);
  EXPECT_EQ(document({"info", "lib.rpz", "HDM_tr_walk_027_120"}).at("take").at("subject"),
            "HDM_tr");
  output({"verify", "lib.rpz", "--against", "in"});
  const auto given = document(
      {"ingest", "given.rpz", "apart", "--asf", "in/HDM_mm.asf", "--asf", "in/HDM_tr.asf"}, 3);
  EXPECT_EQ(given.at("added"), (nlohmann::json{"HDM_tr_run_120"}));
  EXPECT_NE(given.at("rejected")[0].at("why").get<std::string>().find("HDM_mm.asf"),
            std::string::npos);
  EXPECT_EQ(document({"info", "given.rpz", "HDM_tr_run_120"}).at("take").at("subject"), "HDM_tr");
}

TEST_F(InputsTest, ValuesThatNoDegreeOfFreedomTakesComeBack) {
  std::string amc = ":FULLY-SPECIFIED\n:FORCE-ALL-JOINTS-BE-3DOF\n:DEGREES\n";
  for (int f = 1; f <= 30; ++f) {
    const std::string v = std::to_string(f);
    amc += v + "\nroot 1 2 " + v + " 4 5 6\nfemur 1 " + v + " 3\ntibia .5 10 2 " + v +
           " 30\nhand 7 8 " + v + "\n";
  }
  write("in/03.asf", plain_asf());
  write("in/03_01.amc", amc);
  for (const char* fidelity : {"standard", "exact"}) {
    const std::string archive = std::string(fidelity) + ".rpz";
    output({"ingest", archive, "in", "--fidelity", fidelity});
    output({"verify", archive, "--against", "in"});
    output({"extract", archive, "03_01", "-d", std::string("out-") + fidelity});
    EXPECT_EQ(read_file(folder() / (std::string("out-") + fidelity) / "03.asf"), plain_asf());
  }
  EXPECT_EQ(read_file(folder() / "out-exact/03_01.amc"), amc);
  EXPECT_LE(document({"compare", "in/03_01.amc", "out-standard/03_01.amc"}).at("max_mm"), 10.0);
}

// Motion that no curve follows is stored as its text alone.
TEST_F(InputsTest, ExactTakesAnyNumberThatALimitAllows) {
  unsigned state = 7;
  const auto random = [&] {
    state = state * 1664525U + 1013904223U;
    return (state >> 8) / 16777216.0 * 2 - 1;
  };
  for (const double size : {1e7, 9e8}) {
    std::string text = swing(60, 0);
    for (int f = 0; f < 60; ++f) {
      for (int c = 0; c < 4; ++c) {
        text += std::to_string(size * random()) + (c < 3 ? " " : "\n");
      }
    }
    fs::remove(folder() / "lib.rpz");
    write("in/wild.bvh", text);
    write("in/tame.bvh", swing(60, 60));
    output({"ingest", "lib.rpz", "in", "--fidelity", "exact", "--unit-mm", "1000"});
    EXPECT_EQ(output({"extract", "lib.rpz", "wild", "-o", "-"}), text);
    output({"verify", "lib.rpz", "--against", "in"});
    output({"extract", "lib.rpz", "wild", "-o", "-", "--frames", "3:9"});
    output({"extract", "lib.rpz", "wild", "-o", "-", "--fidelity", "preview"});
    output({"repeats", "lib.rpz"});
    output({"search", "lib.rpz", "--id", "wild"});
    output({"stats", "lib.rpz"});
    output({"info", "lib.rpz", "wild"});
  }
}

}  // namespace
}  // namespace reprise::cli
