// The main job from end to end, as a user does it.
#include "cli/command_runner.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

class WholeLifeTest : public CommandTest, public testing::WithParamInterface<const char*> {};

INSTANTIATE_TEST_SUITE_P(Formats, WholeLifeTest, testing::Values("bvh", "amc"));

TEST_P(WholeLifeTest, IntoTheArchiveAndBack) {
  const std::string format = GetParam();
  make_library(format);
  const auto names = take_names();
  ASSERT_EQ(names.size(), 4U);
  output({"extract", "lib.rpz", "--all", "-d", "out"});
  const auto take_list = document({"list", "lib.rpz"});
  for (const auto& take : take_list.at("takes")) {
    const std::string file = take.at("name").get<std::string>() + "." + format;
    const auto apart = document({"compare", "takes/" + file, "out/" + file});
    EXPECT_EQ(apart.at("missing_frames"), 0);
    EXPECT_EQ(apart.at("frames"), take.at("frames"));
    EXPECT_LE(apart.at("mean_mm").get<double>(), 20.0);
    // What the archive says of itself is what an outside measurement finds; files have six
    // decimals.
    EXPECT_NEAR(apart.at("mean_mm").get<double>(), take.at("error_mm").at("mean").get<double>(),
                0.01);
  }
  EXPECT_EQ(document({"verify", "lib.rpz", "--against", "takes"}).at("ok"), true);
}

TEST_P(WholeLifeTest, RemovedTakesAreGoneAndTheirSpaceComesBack) {
  // Enough takes that those removed fill whole pages.
  output({"synth", "many", "--takes", "40", "--seconds", "2", "--format", GetParam()});
  output({"ingest", "lib.rpz", "many", "--fidelity", "preview"});
  const auto names = take_names();
  const std::string kept = output({"extract", "lib.rpz", names[39], "-o", "-"});
  std::vector<std::string> arguments = {"remove", "lib.rpz"};
  arguments.insert(arguments.end(), names.begin(), names.begin() + 38);
  arguments.push_back(names[0]);
  const auto removed = document(arguments);
  EXPECT_EQ(removed.at("removed"), nlohmann::json(std::vector(names.begin(), names.begin() + 38)));
  EXPECT_EQ(take_names(), (std::vector<std::string>{names[38], names[39]}));
  const auto size = fs::file_size(folder() / "lib.rpz");
  const auto compacted = document({"compact", "lib.rpz"});
  EXPECT_EQ(compacted.at("bytes_before"), size);
  EXPECT_EQ(compacted.at("bytes_after"), fs::file_size(folder() / "lib.rpz"));
  EXPECT_LT(fs::file_size(folder() / "lib.rpz"), size);
  output({"verify", "lib.rpz"});
  EXPECT_EQ(output({"extract", "lib.rpz", names[39], "-o", "-"}), kept);
}

TEST_F(CommandTest, TakeOutsideItsFidelityIsOne) {
  make_library();
  const std::string name = take_names().front();
  // Other motion under the same name stands for a source that the archive does not hold.
  output({"synth", "others", "--takes", "4", "--seconds", "3", "--subjects", "2", "--seed", "77"});
  const Outcome outcome = reprise({"verify", "lib.rpz", "--against", "others", "--json"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report.at("ok"), false);
  ASSERT_GE(report.at("damaged").size(), 1U);
  EXPECT_EQ(report["damaged"][0].at("id"), name);
}

TEST_F(CommandTest, SourcesAreFoundByTheEndsOfNames) {
  output({"synth", "takes", "--takes", "2", "--seconds", "2", "--subjects", "2"});
  output({"ingest", "files.rpz", "takes/s01/s01_01.bvh", "takes/s02/s02_01.bvh"});
  EXPECT_EQ(take_names("files.rpz"), (std::vector<std::string>{"s01_01", "s02_01"}));
  output({"verify", "files.rpz", "--against", "takes"});
  output({"ingest", "prefixed.rpz", "takes", "--prefix", "day/1"});
  output({"verify", "prefixed.rpz", "--against", "takes"});
  // The end of two names is neither's.
  fs::create_directories(folder() / "takes/other");
  fs::copy_file(folder() / "takes/s01/s01_01.bvh", folder() / "takes/other/s01_01.bvh");
  const nlohmann::json report = document({"verify", "files.rpz", "--against", "takes"}, 1);
  ASSERT_EQ(report.at("damaged").size(), 1U);
  EXPECT_EQ(report.at("damaged")[0].at("id"), "s01_01");
}

TEST_F(CommandTest, AFolderOfSourcesThatCannotBeReadLeavesTheRestMeasured) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  make_library();
  const fs::path closed = folder() / "takes" / "s01";
  fs::permissions(closed, fs::perms::none);
  const nlohmann::json report = document({"verify", "lib.rpz", "--against", "takes"}, 1);
  const Outcome told = reprise({"verify", "lib.rpz", "--against", "takes"});
  fs::permissions(closed, fs::perms::owner_all);
  std::map<std::string, std::string> why;
  for (const auto& damage : report.at("damaged")) why[damage.at("id")] = damage.at("why");
  EXPECT_NE(why["takes/s01"].find("the folder cannot be read"), std::string::npos);
  EXPECT_EQ(why["s01/s01_01"], "its source is not in the folder");
  EXPECT_FALSE(why.contains("s02/s02_01"));
  EXPECT_GT(report.at("error_mm").at("max"), 0.0);
  EXPECT_EQ(told.exit_code, 1);
  EXPECT_NE(told.out.find("error against the sources"), std::string::npos) << told.out;
}

TEST_F(CommandTest, SourcesAreMeasuredInTheUnitTheyWereStoredIn) {
  output({"synth", "takes", "--takes", "2", "--seconds", "2", "--subjects", "2"});
  output({"ingest", "lib.rpz", "takes/s01", "--unit-mm", "25.4"});
  output({"ingest", "lib.rpz", "takes/s02"});
  EXPECT_EQ(document({"info", "lib.rpz", "s01_01"}).at("take").at("unit_mm"), 25.4);
  output({"verify", "lib.rpz", "--against", "takes"});
  const nlohmann::json report =
      document({"verify", "lib.rpz", "--against", "takes", "--unit-mm", "10"}, 1);
  EXPECT_EQ(report.at("damaged").at(0).at("id"), "s01_01") << "what is asked for counts";
}

TEST_F(CommandTest, ResultsAndMessagesDoNotMix) {
  make_library();
  const std::string name = take_names().front();
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"list", "lib.rpz"},
                                             {"info", "lib.rpz"},
                                             {"stats", "lib.rpz"},
                                             {"verify", "lib.rpz"},
                                             {"info", "lib.rpz", name},
                                             {"list", "lib.rpz", "--clips"}}) {
    const Outcome outcome = reprise(arguments);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "") << arguments.front();
    EXPECT_NE(outcome.out, "") << arguments.front();
    EXPECT_EQ(outcome.out.find('\033'), std::string::npos) << "colour without a terminal";
  }
  const Outcome verbose = reprise({"ingest", "lib.rpz", "takes", "--json", "-v"});
  EXPECT_TRUE(nlohmann::json::accept(verbose.out)) << verbose.out;
  EXPECT_NE(verbose.err.find(name), std::string::npos) << verbose.err;
  const Outcome quiet = reprise({"ingest", "lib.rpz", "takes", "-q"});
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(CommandTest, LocaleDoesNotChangeNumbers) {
  make_library();
  const std::string name = take_names().front();
  output({"extract", "lib.rpz", name, "-o", "x.bvh"});
  const std::vector<std::vector<std::string>> commands{
      {"stats", "lib.rpz"},
      {"stats", "lib.rpz", "--json"},
      {"list", "lib.rpz"},
      {"info", "lib.rpz", name},
      {"extract", "lib.rpz", name, "-o", "-"},
      {"compare", "takes/" + name + ".bvh", "x.bvh"}};
  // The first that is installed has an effect; names of others are ignored by the C library.
  for (const char* locale : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "C.UTF-8"}) {
    const Surroundings surroundings{.environment = {{"LC_ALL", locale}, {"LANG", locale}},
                                    .input = {}};
    for (const auto& arguments : commands) {
      EXPECT_EQ(reprise(arguments, surroundings).out, output(arguments))
          << locale << ": " << arguments.front();
    }
  }
  const Surroundings german{.environment = {{"LC_ALL", "de_DE.UTF-8"}}, .input = {}};
  EXPECT_EQ(reprise({"ingest", "german.rpz", "takes", "--mean-mm", "2.5"}, german).exit_code, 0);
  output({"ingest", "plain.rpz", "takes", "--mean-mm", "2.5"});
  EXPECT_EQ(content_digest("german.rpz"), content_digest("plain.rpz"));
}

TEST_F(CommandTest, ReadingDoesNotWrite) {
  make_library();
  const auto before = files_below(folder());
  const std::string name = take_names().front();
  output({"stats", "lib.rpz"});
  output({"verify", "lib.rpz"});
  output({"extract", "lib.rpz", name, "-o", "-"});
  EXPECT_EQ(files_below(folder()), before);
}

}  // namespace
}  // namespace reprise::cli
