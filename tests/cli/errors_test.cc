// Exit codes and what is said where, for each class of mistake.
#include <fcntl.h>
#include <signal.h>
#include <sqlite3.h>
#include <unistd.h>

#include "cli/command_runner.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

class ErrorsTest : public CommandTest {
 protected:
  void expect_usage(const std::vector<std::string>& arguments, const std::string& said) const {
    const Outcome outcome = reprise(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments.front() << ": " << outcome.err;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  /// Runs the command where no file may have more than `bytes`, in units of 512.
  Outcome limited(std::size_t bytes, const std::string& command) const {
    const std::string line =
        "ulimit -f " + std::to_string(bytes / 512) + "; " REPRISE_COMMAND " " + command;
    return RunningCommand(folder(), {"sh", "-c", line}).wait();
  }
};

TEST_F(ErrorsTest, WrongUsageIsTwoAndTouchesNothing) {
  expect_usage({}, "command is missing");
  expect_usage({"ingets", "lib.rpz", "takes"}, "did you mean ingest?");
  expect_usage({"ingest", "lib.rpz", "takes", "--jbos", "2"}, "did you mean --jobs?");
  expect_usage({"list", "--clisp"}, "did you mean --clips?");
  expect_usage({"ingest", "lib.rpz"}, "PATH");
  expect_usage({"ingest", "lib.rpz", "takes", "--jobs", "0"}, "--jobs");
  expect_usage({"ingest", "lib.rpz", "takes", "--jobs", "many"}, "--jobs");
  expect_usage({"ingest", "lib.rpz", "takes", "--mean-mm", "2,5"}, "--mean-mm");
  expect_usage({"ingest", "lib.rpz", "takes", "--prefix", "../up"}, "--prefix");
  expect_usage({"ingest", "lib.rpz", "-"}, "stdin");
  expect_usage({"ingest", "-", "takes"}, "stdin");
  expect_usage({"list", "lib.rpz", "--kind", "rare"}, "--kind");
  expect_usage({"list", "lib.rpz", "--clips", "--skeletons"}, "exclude");
  expect_usage({"list", "lib.rpz", "--color", "always"}, "--color");
  expect_usage({"stats", "lib.rpz", "more"}, "unexpected argument \"more\"");
  expect_usage({"synth", "takes", "--takes", "0"}, "--takes");
  expect_usage({"synth", "takes", "--format", "fbx"}, "--format");
  expect_usage({"compare", "-", "-"}, "stdin");
  EXPECT_TRUE(fs::is_empty(folder()));
}

TEST_F(ErrorsTest, ExtractChecksItsArgumentsFirst) {
  expect_usage({"extract", "lib.rpz", "a"}, "-o FILE");
  expect_usage({"extract", "lib.rpz", "-o", "x.bvh"}, "--all");
  expect_usage({"extract", "lib.rpz", "a", "--all", "-d", "out"}, "--all");
  expect_usage({"extract", "lib.rpz", "a", "b", "-o", "x.bvh"}, "one ID");
  expect_usage({"extract", "lib.rpz", "a", "-o", "x.bvh", "-d", "out"}, "-o FILE");
  expect_usage({"extract", "lib.rpz", "a", "-o", "-", "--frames", "9:3"}, "--frames");
  expect_usage({"extract", "lib.rpz", "a", "-o", "-", "--time", "soon:"}, "--time");
  expect_usage({"extract", "lib.rpz", "a", "-o", "-", "--frames", "1:", "--time", "1:"}, "exclude");
  expect_usage({"extract", "lib.rpz", "a", "-o", "-", "--format", "csv"}, "--format");
  expect_usage({"extract", "lib.rpz", "a", "-o", "-", "--fidelity", "best"}, "--fidelity");
  EXPECT_TRUE(fs::is_empty(folder()));
}

TEST_F(ErrorsTest, FidelitiesThatDoNotGoTogetherAreRefused) {
  const auto refused = [&](std::vector<std::string> more, const std::string& why) {
    std::vector<std::string> words = {"ingest", "lib.rpz", "takes"};
    words.insert(words.end(), more.begin(), more.end());
    expect_usage(words, why);
  };
  refused({"--fidelity", "best"}, "--fidelity");
  refused({"--fidelity", "fine", "--bound-mm", "5"}, "excludes");
  refused({"--fidelity", "exact", "--mean-mm", "5"}, "--mean-mm");
  refused({"--bound-mm", "5", "--mean-mm", "5"}, "--mean-mm");
  refused({"--bound-mm", "0.01"}, "--bound-mm");
  refused({"--bound-mm", "101"}, "--bound-mm");
  refused({"--bound-deg", "5"}, "--bound-mm");
  refused({"--bound-mm", "5", "--bound-deg", "181"}, "--bound-deg");
}

TEST_F(ErrorsTest, WhatIsNotStoredCannotBeExtracted) {
  make_library();
  const std::string take = take_names().front();
  expect_usage({"extract", "lib.rpz", take, "-o", "x.bvh", "--fidelity", "fine"},
               "stored as standard");
  expect_usage({"extract", "lib.rpz", take, "-o", "x.bvh", "--format", "amc"}, "bvh");
  EXPECT_FALSE(fs::exists(folder() / "x.bvh"));
  output({"extract", "lib.rpz", take, "-o", "x.bvh", "--fidelity", "preview", "--format", "bvh"});
}

TEST_F(ErrorsTest, MissingArchiveFails) {
  for (const char* command : {"list", "info", "stats", "verify", "compact"}) {
    const Outcome outcome = reprise({command, "nowhere.rpz"});
    EXPECT_EQ(outcome.exit_code, 1) << command;
    EXPECT_NE(outcome.err.find("nowhere.rpz"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(reprise({"compare", "a.bvh", "b.bvh"}).exit_code, 1);
  EXPECT_TRUE(fs::is_empty(folder()));
}

TEST_F(ErrorsTest, MissingInputEndsBeforeAnythingIsStored) {
  output({"synth", "takes", "--takes", "2", "--seconds", "2"});
  const Outcome outcome = reprise({"ingest", "lib.rpz", "takes", "nowhere.bvh"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("nowhere.bvh: "), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder() / "lib.rpz"));
}

TEST_F(ErrorsTest, UnknownAndAmbiguousIdsAreSeven) {
  make_library();
  EXPECT_EQ(reprise({"info", "lib.rpz", "no-such-take"}).exit_code, 7);
  EXPECT_EQ(reprise({"remove", "lib.rpz", "no-such-take"}).exit_code, 7);
  EXPECT_EQ(reprise({"extract", "lib.rpz", "no-such-take", "-d", "out"}).exit_code, 7);
  output({"ingest", "lib.rpz", "takes", "--prefix", "again"});
  const std::string name = take_names().back();
  const std::string tail = name.substr(name.rfind('/') + 1);
  const Outcome outcome = reprise({"info", "lib.rpz", tail});
  EXPECT_EQ(outcome.exit_code, 7);
  EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("again/" + name), std::string::npos) << outcome.err;
}

TEST_F(ErrorsTest, OneUnknownIdAmongSeveralChangesNothing) {
  make_library();
  const std::string take = take_names().front();
  EXPECT_EQ(reprise({"extract", "lib.rpz", take, "no-such-take", "-d", "out"}).exit_code, 7);
  EXPECT_FALSE(fs::exists(folder() / "out"));
  EXPECT_EQ(reprise({"remove", "lib.rpz", take, "no-such-take"}).exit_code, 7);
  EXPECT_EQ(take_names().size(), 4U);
}

TEST_F(ErrorsTest, DamageIsFour) {
  make_library();
  write_file(folder() / "text.rpz", "not an archive, but a text of some length\n");
  EXPECT_EQ(reprise({"list", "text.rpz"}).exit_code, 4);
  EXPECT_EQ(reprise({"ingest", "text.rpz", "takes"}).exit_code, 4);
  EXPECT_EQ(document({"verify", "text.rpz"}, 4).at("ok"), false);

  const std::string whole = read_file(folder() / "lib.rpz");
  write_file(folder() / "short.rpz", whole.substr(0, whole.size() / 2));
  EXPECT_EQ(reprise({"verify", "short.rpz"}).exit_code, 4);

  // A byte of the motion: somewhere past the middle of the file there is nothing else.
  bool seen = false;
  for (std::size_t at = whole.size() / 2; at < whole.size(); at += whole.size() / 16) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x10);
    write_file(folder() / "flipped.rpz", flipped);
    const Outcome outcome = reprise({"verify", "flipped.rpz"});
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 4) << at << ": " << outcome.err;
    seen = seen || outcome.exit_code == 4;
  }
  EXPECT_TRUE(seen);
}

TEST_F(ErrorsTest, WhatCannotBeOpenedIsCalledWhatItIs) {
  make_library();
  write_file(folder() / "text.rpz", "not an archive, but a text of some length\n");
  std::string ahead = read_file(folder() / "lib.rpz");
  ahead[18] = ahead[19] = 2;  // as a database in WAL mode has it
  write_file(folder() / "wal.rpz", ahead);
  const std::map<std::string, std::string> words = {{"text.rpz", "this is not a Reprise archive"},
                                                    {"wal.rpz", "WAL mode"}};
  for (const auto& [name, words_of_it] : words) {
    for (const char* command : {"list", "verify", "compact"}) {
      const Outcome outcome = reprise({command, name});
      EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
      EXPECT_NE(outcome.err.find(words_of_it), std::string::npos) << outcome.err;
      EXPECT_EQ(outcome.err.find("damaged"), std::string::npos) << outcome.err;
      EXPECT_EQ(outcome.out, "");
    }
  }
}

// The words of a library that users do not know say nothing to them.
TEST_F(ErrorsTest, DamageIsToldInOurWords) {
  make_library();
  std::string bytes = read_file(folder() / "lib.rpz");
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((folder() / "lib.rpz").c_str(), &database), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(database,
                         "DELETE FROM keys WHERE id=(SELECT max(id) FROM keys); "
                         "UPDATE blocks SET takes=zeroblob(9)",
                         nullptr, nullptr, nullptr),
            SQLITE_OK);
  sqlite3_close(database);
  for (std::size_t at :
       {std::size_t{0}, std::size_t{1024}, std::size_t{2048}, bytes.size() - 1024}) {
    std::string torn = at == 0 ? read_file(folder() / "lib.rpz") : bytes;
    if (at > 0) torn.replace(at, 512, std::string(512, '\x7f'));
    write_file(folder() / "torn.rpz", torn);
    const Outcome outcome = reprise({"verify", "torn.rpz"});
    EXPECT_EQ(outcome.exit_code, 4);
    for (const char* word : {"malformed", "btree", "Tree", "disk image", "rowid", "SQLite"}) {
      EXPECT_EQ((outcome.out + outcome.err).find(word), std::string::npos)
          << outcome.out << outcome.err;
    }
  }
}

TEST_F(ErrorsTest, NewerVersionIsFive) {
  make_library();
  // SQLite's header has the user version at byte 60, big-endian.
  std::string newer = read_file(folder() / "lib.rpz");
  ASSERT_GT(newer.size(), 64U);
  newer[60] = 0x7F;
  write_file(folder() / "newer.rpz", newer);
  EXPECT_EQ(reprise({"list", "newer.rpz"}).exit_code, 5);
  EXPECT_EQ(reprise({"verify", "newer.rpz"}).exit_code, 5);
}

TEST_F(ErrorsTest, SecondWriterIsSix) {
  make_library();
  sqlite3* holder = nullptr;
  ASSERT_EQ(sqlite3_open((folder() / "lib.rpz").c_str(), &holder), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(holder, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
  EXPECT_EQ(reprise({"ingest", "lib.rpz", "takes", "--prefix", "more"}).exit_code, 6);
  EXPECT_EQ(reprise({"remove", "lib.rpz", take_names().front()}).exit_code, 6);
  EXPECT_EQ(reprise({"list", "lib.rpz"}).exit_code, 0) << "readers are not kept out";
  sqlite3_exec(holder, "ROLLBACK", nullptr, nullptr, nullptr);
  sqlite3_close(holder);
  EXPECT_EQ(reprise({"ingest", "lib.rpz", "takes", "--prefix", "more"}).exit_code, 0);
}

TEST_F(ErrorsTest, NamesThatSqliteHasAMeaningForAreNamesOfFiles) {
  make_library();
  for (const std::string name : {":memory:", "file:lib.rpz", "file:other.rpz?mode=memory", "-x"}) {
    const Outcome outcome = reprise({"ingest", "--no-repeats", "--", name, "takes"});
    EXPECT_EQ(outcome.exit_code, 0) << name << outcome.err;
    EXPECT_EQ(take_names("./" + name), take_names()) << name;
    EXPECT_EQ(reprise({"verify", "--", name}).exit_code, 0) << name;
  }
  EXPECT_FALSE(fs::exists(folder() / "other.rpz"));
}

TEST_F(ErrorsTest, AFolderThatMayNotBeWrittenIsCalledThat) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  make_library();
  const std::string take = take_names().front();
  fs::permissions(folder(), fs::perms::owner_read | fs::perms::owner_exec);
  const Outcome outcome = reprise({"remove", "lib.rpz", take});
  fs::permissions(folder(), fs::perms::owner_all);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("the folder of the archive cannot be written"), std::string::npos)
      << outcome.err;
}

TEST_F(ErrorsTest, ExistingOutputStays) {
  make_library();
  const std::string take = take_names().front();
  write_file(folder() / "mine.bvh", "mine");
  const Outcome refused = reprise({"extract", "lib.rpz", take, "-o", "mine.bvh"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("--overwrite"), std::string::npos) << refused.err;
  EXPECT_EQ(read_file(folder() / "mine.bvh"), "mine");
  output({"extract", "lib.rpz", take, "-o", "mine.bvh", "--overwrite"});
  EXPECT_NE(read_file(folder() / "mine.bvh"), "mine");
  EXPECT_EQ(reprise({"synth", "takes", "--takes", "4", "--subjects", "2"}).exit_code, 1);
  output({"synth", "takes", "--takes", "4", "--subjects", "2", "--overwrite"});
}

TEST_F(ErrorsTest, FullStdoutIsAnError) {
  make_library();
  const int full = open("/dev/full", O_WRONLY);
  if (full < 0) GTEST_SKIP() << "no /dev/full";
  close(full);
  const std::string take = take_names().front();
  for (const std::string& what :
       {std::string("list lib.rpz"), "extract lib.rpz " + take + " -o -"}) {
    const std::string line = std::string(REPRISE_COMMAND) + " " + what + " > /dev/full";
    EXPECT_EQ(RunningCommand(folder(), {"sh", "-c", line}).wait().exit_code, 9) << what;
  }
}

TEST_F(ErrorsTest, AnArchiveThatMayNotGrowIsNineAndStays) {
  make_library();
  const std::string before = read_file(folder() / "lib.rpz");
  const std::map<std::string, std::size_t> limits = {{"lib.rpz", before.size()}, {"new.rpz", 2048}};
  for (const auto& [archive, bytes] : limits) {
    const Outcome outcome = limited(bytes, "ingest " + archive + " takes --prefix more");
    EXPECT_EQ(outcome.exit_code, 9) << outcome.err;
    EXPECT_NE(outcome.err.find("limit on the size of files"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(read_file(folder() / "lib.rpz"), before);
  EXPECT_FALSE(fs::exists(folder() / "new.rpz"));
  output({"verify", "lib.rpz"});
  EXPECT_EQ(document({"ingest", "lib.rpz", "takes", "--prefix", "more"}).at("added").size(), 4U);
}

TEST_F(ErrorsTest, AFileThatMayNotGrowIsNineAndGone) {
  make_library();
  const auto before = files_below(folder());
  const std::string take = take_names().front();
  const std::vector<std::string> commands = {
      "extract lib.rpz " + take + " -o big.bvh", "extract lib.rpz --all -d .",
      "plot lib.rpz --summary " + take + " -o big.png", "synth ."};
  for (const std::string& command : commands) {
    EXPECT_EQ(limited(512, command).exit_code, 9) << command;
    EXPECT_EQ(files_below(folder()), before) << command;
  }
}

TEST_F(ErrorsTest, HelpAndVersionAreResults) {
  EXPECT_EQ(output({"--version"}).rfind("reprise ", 0), 0U);
  EXPECT_NE(output({"--help"}).find("ingest"), std::string::npos);
  for (const char* command : {"ingest", "list", "info", "extract", "stats", "compare", "verify",
                              "remove", "compact", "synth"}) {
    const std::string help = output({command, "--help"});
    EXPECT_NE(help.find(std::string("Example:\n  reprise ") + command), std::string::npos) << help;
  }
}

}  // namespace
}  // namespace reprise::cli
