// What ingest promises about names, repetition, order and sources.
#include <algorithm>

#include "cli/command_runner.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

class IngestTest : public CommandTest {
 protected:
  /// Replaces every take of the folder by those of another seed.
  void change_takes() const {
    output({"synth", "takes", "--takes", "4", "--seconds", "3", "--subjects", "2", "--seed", "9",
            "--overwrite"});
  }
};

TEST_F(IngestTest, AgainSkipsAndChangesNothing) {
  make_library();
  const std::string digest = content_digest();
  const auto again = document({"ingest", "lib.rpz", "takes"});
  EXPECT_EQ(again.at("skipped").size(), 4U);
  EXPECT_EQ(again.at("added").size(), 0U);
  EXPECT_EQ(content_digest(), digest);
}

TEST_F(IngestTest, JobsDoNotChangeTheContent) {
  make_library();
  output({"ingest", "one.rpz", "takes", "--jobs", "1"});
  output({"ingest", "two.rpz", "takes", "--jobs", "2"});
  EXPECT_EQ(content_digest("one.rpz"), content_digest("two.rpz"));
  EXPECT_EQ(content_digest("one.rpz"), content_digest("lib.rpz"));
}

TEST_F(IngestTest, OrderOfArgumentsDoesNotChangeTheContent) {
  make_library();
  std::vector<std::string> files;
  for (const auto& [name, content] : files_below(folder() / "takes")) {
    if (name.ends_with(".bvh")) files.push_back("takes/" + name);
  }
  std::vector<std::string> forth{"ingest", "forth.rpz"};
  std::vector<std::string> back{"ingest", "back.rpz"};
  forth.insert(forth.end(), files.begin(), files.end());
  back.insert(back.end(), files.rbegin(), files.rend());
  output(forth);
  output(back);
  EXPECT_EQ(content_digest("forth.rpz"), content_digest("back.rpz"));
}

TEST_F(IngestTest, AFileGivenTwiceHasOneNameInAnyOrder) {
  make_library();
  const std::string file = "takes/" + take_names().front() + ".bvh";
  output({"ingest", "forth.rpz", "takes", file});
  output({"ingest", "back.rpz", file, "takes"});
  EXPECT_EQ(take_names("forth.rpz"), take_names());
  EXPECT_EQ(content_digest("back.rpz"), content_digest("forth.rpz"));
}

TEST_F(IngestTest, ALinkIsATakeOfItsFolderAndNeverHidesItsFile) {
  make_library();
  const std::string file = "../../takes/" + take_names().front() + ".bvh";
  fs::create_directories(folder() / "picked/anna");
  fs::create_symlink(file, folder() / "picked/anna/best.bvh");
  EXPECT_EQ(document({"ingest", "picked.rpz", "picked"}).at("added").size(), 1U);
  const auto take = document({"list", "picked.rpz"}).at("takes").at(0);
  EXPECT_EQ(take.at("name"), "anna/best");
  EXPECT_EQ(take.at("subject"), "anna");
  // Whichever of the two a folder names first.
  const fs::path real = folder() / "takes" / (take_names().front() + ".bvh");
  fs::create_symlink(real.filename(), real.parent_path() / "a_link.bvh");
  fs::create_symlink(real.filename(), real.parent_path() / "z_link.bvh");
  EXPECT_EQ(document({"ingest", "lib.rpz", "takes"}).at("added").size(), 0U);
}

TEST_F(IngestTest, OtherContentUnderTheSameNameNeedsReplace) {
  make_library();
  const std::string digest = content_digest();
  change_takes();
  const Outcome refused = reprise({"ingest", "lib.rpz", "takes"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("--replace"), std::string::npos) << refused.err;
  EXPECT_EQ(content_digest(), digest);
  const auto replaced = document({"ingest", "lib.rpz", "takes", "--replace"});
  EXPECT_EQ(replaced.at("added").size(), 4U);
  EXPECT_EQ(take_names().size(), 4U);
  EXPECT_NE(content_digest(), digest);
  output({"verify", "lib.rpz", "--against", "takes"});
}

TEST_F(IngestTest, PrefixGoesInFrontOfNames) {
  make_library();
  const auto before = take_names();
  change_takes();
  output({"ingest", "lib.rpz", "takes", "--prefix", "day2/"});
  const auto after = take_names();
  EXPECT_EQ(after.size(), 8U);
  for (const std::string& name : before) {
    EXPECT_EQ(std::count(after.begin(), after.end(), name), 1) << name;
    EXPECT_EQ(std::count(after.begin(), after.end(), "day2/" + name), 1) << name;
  }
}

TEST_F(IngestTest, MetadataIsShownAndSearched) {
  make_library();
  const auto names = take_names();
  write_file(folder() / "takes.csv", "take,subject,description,tags\n" + names[0] +
                                         ",Ada,\"slow walk, then a turn\",gait\n" + names[1] +
                                         ",Ben,quick wave,gesture\n");
  output({"ingest", "told.rpz", "takes", "--metadata", "takes.csv"});
  Surroundings piped;
  piped.input = "takes.csv";
  EXPECT_EQ(reprise({"ingest", "piped.rpz", "takes", "--metadata", "-"}, piped).exit_code, 0);
  EXPECT_EQ(content_digest("piped.rpz"), content_digest("told.rpz"));
  const auto take = document({"info", "told.rpz", names[0]}).at("take");
  EXPECT_EQ(take.at("subject"), "Ada");
  EXPECT_EQ(take.at("description"), "slow walk, then a turn");
  EXPECT_EQ(take.at("tags"), "gait");
  const auto found = document({"list", "told.rpz", "--text", "turn slow"}).at("takes");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].at("name"), names[0]);
  EXPECT_EQ(document({"list", "told.rpz", "--text", "gesture"}).at("takes").at(0).at("name"),
            names[1]);
  EXPECT_EQ(document({"list", "told.rpz", "--text", "swimming"}).at("takes").size(), 0U);
  EXPECT_EQ(document({"list", "told.rpz", "--subject", "Ben"}).at("takes").size(), 1U);
  for (const char* odd : {"\"", "a OR", "*", "NEAR(", "'; --", "walk*\""}) {
    EXPECT_EQ(reprise({"list", "told.rpz", "--text", odd}).exit_code, 0) << odd;
  }
}

TEST_F(IngestTest, MetadataThatComesLaterReplacesTakes) {
  make_library();
  const auto names = take_names();
  const auto clips = document({"list", "lib.rpz", "--clips"}).at("clips");
  write_file(folder() / "takes.csv", "take,description\n" + names[0] + ",a slow walk\n");
  const std::vector<std::string> again = {"ingest", "lib.rpz", "takes", "--metadata", "takes.csv"};
  const auto kept = document(again);
  EXPECT_EQ(kept.at("other_metadata"), nlohmann::json::array({names[0]}));
  EXPECT_EQ(document({"list", "lib.rpz", "--text", "slow"}).at("takes").size(), 0U);
  std::vector<std::string> replacing = again;
  replacing.push_back("--replace");
  EXPECT_EQ(document(replacing).at("added"), nlohmann::json::array({names[0]}));
  EXPECT_EQ(document({"list", "lib.rpz", "--text", "slow"}).at("takes").size(), 1U);
  EXPECT_EQ(document({"list", "lib.rpz", "--clips"}).at("clips").size(), clips.size());
  EXPECT_EQ(document(replacing).at("added").size(), 0U);
  EXPECT_EQ(document(again).at("other_metadata").size(), 0U);
}

TEST_F(IngestTest, WhatWasToldOfATakeStaysWhenItIsReplaced) {
  make_library();
  const std::string name = take_names().front();
  write_file(folder() / "takes.csv", "take,subject,tags\n" + name + ",Anna,gait\n");
  output({"ingest", "told.rpz", "takes", "--metadata", "takes.csv"});
  output({"ingest", "told.rpz", "takes", "--replace", "--fidelity", "fine"});
  const auto take = document({"info", "told.rpz", name}).at("take");
  EXPECT_EQ(take.at("fidelity"), "fine");
  EXPECT_EQ(take.at("subject"), "Anna");
  EXPECT_EQ(take.at("tags"), "gait");
}

TEST_F(IngestTest, AnotherUnitOrFrameRateIsToldOrReplaces) {
  make_library("amc");
  const std::string name = take_names().front();
  const Outcome told = reprise({"ingest", "lib.rpz", "takes", "--fps", "60"});
  EXPECT_NE(told.err.find("4 takes stored with another unit, up axis or frame rate"),
            std::string::npos)
      << told.err;
  EXPECT_EQ(document({"info", "lib.rpz", name}).at("take").at("frame_rate"), 120.0);
  EXPECT_EQ(document({"ingest", "lib.rpz", "takes", "--fps", "60", "--replace"}).at("added").size(),
            4U);
  EXPECT_EQ(document({"info", "lib.rpz", name}).at("take").at("frame_rate"), 60.0);
  EXPECT_EQ(document({"ingest", "lib.rpz", "takes", "--fps", "60"}).at("other_reading").size(), 0U);
}

// More folders, one in another, than may be open at a time.
TEST_F(IngestTest, AFolderThatCannotBeSearchedToItsEndIsNoSuccess) {
  make_library();
  std::string deep = "takes";
  for (int level = 0; level < 40; ++level) deep.append("/").append(std::to_string(level));
  fs::create_directories(folder() / deep);
  const Outcome outcome =
      RunningCommand(folder(),
                     {"sh", "-c", "ulimit -n 24; exec " REPRISE_COMMAND " ingest new.rpz takes"})
          .wait();
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_FALSE(fs::exists(folder() / "new.rpz"));
}

TEST_F(IngestTest, ColumnsAreKnownInAnyCase) {
  make_library();
  const std::string name = take_names().front();
  write_file(folder() / "takes.csv", "Take, Subject ,TAGS\n" + name + ",Anna,walk\n");
  output({"ingest", "told.rpz", "takes", "--metadata", "takes.csv"});
  const auto take = document({"info", "told.rpz", name}).at("take");
  EXPECT_EQ(take.at("subject"), "Anna");
  EXPECT_EQ(take.at("tags"), "walk");
}

TEST_F(IngestTest, ATableThatSaysTwoThingsOfATakeIsRefused) {
  make_library();
  const std::string name = take_names().front();
  write_file(folder() / "takes.csv",
             "take,subject\n" + name + ",Anna\n" + name + ",Anna\n" + name + ",Bob\n");
  const Outcome outcome = reprise({"ingest", "told.rpz", "takes", "--metadata", "takes.csv"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("takes.csv:4: the table says two things of the take '" + name + "'"),
            std::string::npos)
      << outcome.err;
  EXPECT_FALSE(fs::exists(folder() / "told.rpz"));
}

TEST_F(IngestTest, ATableThatIsNoneIsNamedWithItsLine) {
  make_library();
  write_file(folder() / "quote.csv", "take,subject\n\na,\"two\nlines\"\nb,An\"na\n");
  const Outcome quote = reprise({"ingest", "told.rpz", "takes", "--metadata", "quote.csv"});
  EXPECT_EQ(quote.exit_code, 1);
  EXPECT_NE(quote.err.find("quote.csv:5: "), std::string::npos) << quote.err;
  Surroundings piped;
  piped.input = folder() / "quote.csv";
  const Outcome from_stdin = reprise({"ingest", "told.rpz", "takes", "--metadata", "-"}, piped);
  EXPECT_NE(from_stdin.err.find("stdin:5: "), std::string::npos) << from_stdin.err;
  write_file(folder() / "lines.csv", "take,subject\n\na,\"two\nlines\"\nb,Anna\nb,Bob\n");
  const Outcome twice = reprise({"ingest", "told.rpz", "takes", "--metadata", "lines.csv"});
  EXPECT_NE(twice.err.find("lines.csv:6: "), std::string::npos) << twice.err;
}

TEST_F(IngestTest, RowsOfNoTakeAreTold) {
  make_library();
  const std::string name = take_names().front();
  const std::string file_name = name.substr(name.rfind('/') + 1);
  write_file(folder() / "takes.csv",
             "take,tags\n" + file_name + ",gait\nnobody_01,gait\nnobody_02,gait\n");
  const auto told = reprise({"ingest", "told.rpz", "takes", "--metadata", "takes.csv"});
  EXPECT_EQ(told.exit_code, 0);
  EXPECT_NE(told.err.find("takes.csv: 2 rows of no take that was given, such as 'nobody_01'"),
            std::string::npos)
      << told.err;
  EXPECT_EQ(
      document({"ingest", "told.rpz", "takes", "--metadata", "takes.csv"}).at("takes_not_found"),
      nlohmann::json::array({"nobody_01", "nobody_02"}));
  EXPECT_EQ(document({"list", "told.rpz", "--text", "gait"}).at("takes").size(), 1U);
}

TEST_F(IngestTest, FiltersNarrowLists) {
  make_library();
  const std::string name = take_names().front();
  EXPECT_EQ(document({"list", "lib.rpz", "--take", name}).at("takes").size(), 1U);
  const auto clip_list = document({"list", "lib.rpz", "--clips", "--take", name});
  for (const auto& clip : clip_list.at("clips")) {
    EXPECT_EQ(clip.at("take"), name);
  }
  const auto all = document({"list", "lib.rpz", "--clips"}).at("clips");
  std::size_t together = 0;
  for (const char* kind : {"primary", "repeated", "unique"}) {
    const auto some = document({"list", "lib.rpz", "--clips", "--kind", kind}).at("clips");
    for (const auto& clip : some) EXPECT_EQ(clip.at("kind"), kind);
    together += some.size();
  }
  EXPECT_EQ(together, all.size());
}

TEST_F(IngestTest, SourcesStayAsTheyAre) {
  output({"synth", "takes", "--takes", "3", "--seconds", "2"});
  const auto before = files_below(folder() / "takes");
  output({"ingest", "lib.rpz", "takes"});
  output({"verify", "lib.rpz", "--against", "takes"});
  EXPECT_EQ(files_below(folder() / "takes"), before);
}

TEST_F(IngestTest, DryRunWritesNothing) {
  output({"synth", "takes", "--takes", "3", "--seconds", "2"});
  const auto before = files_below(folder());
  const auto dry = document({"ingest", "lib.rpz", "takes", "--dry-run"});
  EXPECT_EQ(dry.at("added").size(), 3U);
  EXPECT_EQ(files_below(folder()), before);
  output({"ingest", "lib.rpz", "takes"});
  const std::string archive = read_file(folder() / "lib.rpz");
  EXPECT_EQ(document({"ingest", "lib.rpz", "takes", "--dry-run"}).at("skipped").size(), 3U);
  EXPECT_EQ(read_file(folder() / "lib.rpz"), archive);
}

TEST_F(IngestTest, MeanIsHeld) {
  output({"synth", "takes", "--takes", "3", "--seconds", "3"});
  output({"ingest", "fine.rpz", "takes", "--mean-mm", "3"});
  output({"ingest", "coarse.rpz", "takes", "--mean-mm", "30"});
  const auto take_list = document({"list", "fine.rpz"});
  for (const auto& take : take_list.at("takes")) {
    EXPECT_LE(take.at("error_mm").at("mean").get<double>(), 3.0);
  }
  EXPECT_LT(document({"stats", "coarse.rpz"}).at("payload_bytes"),
            document({"stats", "fine.rpz"}).at("payload_bytes"));
}

TEST_F(IngestTest, TurnsAreHeld) {
  output({"synth", "takes", "--takes", "2", "--seconds", "3"});
  output({"ingest", "coarse.rpz", "takes", "--bound-mm", "10"});
  output({"ingest", "fine.rpz", "takes", "--bound-mm", "10", "--bound-deg", "2"});
  for (const auto& [archive, degrees] : {std::pair{"coarse.rpz", 10.0}, {"fine.rpz", 2.0}}) {
    const auto take_list = document({"list", archive});
    ASSERT_EQ(take_list.at("takes").size(), 2U);
    for (const auto& take : take_list.at("takes")) {
      EXPECT_EQ(take.at("limit_deg"), degrees);
      EXPECT_LE(take.at("rotation_deg").at("max").get<double>(), degrees);
      EXPECT_GT(take.at("rotation_deg").at("max").get<double>(), 0.1 * degrees);
    }
    EXPECT_EQ(document({"verify", archive, "--against", "takes"}).at("ok"), true);
  }
  EXPECT_LT(document({"stats", "coarse.rpz"}).at("payload_bytes"),
            document({"stats", "fine.rpz"}).at("payload_bytes"));
}

TEST_F(IngestTest, OddNamesAreJustNames) {
  output({"synth", "takes", "--takes", "1", "--seconds", "2"});
  std::string text;
  for (const auto& [name, content] : files_below(folder() / "takes")) {
    if (name.ends_with(".bvh")) text = content;
  }
  for (const char* name : {"-dash.bvh", "[set]/a,b.bvh", "list/two words.bvh"}) {
    write_file(folder() / "odd" / name, text);
  }
  write_file(folder() / "-top.bvh", text);
  write_file(folder() / "[x]/c.bvh", text);
  EXPECT_EQ(document({"ingest", "odd.rpz", "odd"}).at("added").size(), 3U);
  EXPECT_EQ(reprise({"ingest", "top.rpz", "--", "-top.bvh", "[x]", "odd/list"}).exit_code, 0);
  EXPECT_EQ(take_names("top.rpz").size(), 3U);
  output({"extract", "odd.rpz", "--all", "-d", "out"});
  EXPECT_TRUE(fs::exists(folder() / "out/[set]/a,b.bvh"));
  EXPECT_EQ(reprise({"info", "odd.rpz", "--", "-dash"}).exit_code, 0);
}

}  // namespace
}  // namespace reprise::cli
