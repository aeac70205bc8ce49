// Decoded motion in files: whole, in part, in trees, and never where it should not be.
#include <cmath>
#include <set>

#include "cli/command_runner.h"
#include "reprise/formats/motion_file.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

class ExtractTest : public CommandTest {
 protected:
  Take read(const fs::path& path) const { return read_motion_file(folder() / path); }
};

TEST_F(ExtractTest, StdoutAndFileAreTheSame) {
  make_library();
  const std::string take = take_names().front();
  output({"extract", "lib.rpz", take, "-o", "x.bvh"});
  EXPECT_EQ(output({"extract", "lib.rpz", take, "-o", "-"}), read_file(folder() / "x.bvh"));
}

TEST_F(ExtractTest, PartsAreSlicesOfTheWhole) {
  make_library();
  const std::string name = take_names().front();
  output({"extract", "lib.rpz", name, "-o", "whole.bvh"});
  const Take whole = read("whole.bvh");
  const auto expect_slice = [&](const std::vector<std::string>& part, long begin, long end) {
    std::vector<std::string> arguments{"extract", "lib.rpz", name, "-o", "part.bvh", "--overwrite"};
    arguments.insert(arguments.end(), part.begin(), part.end());
    output(arguments);
    const Take slice = read("part.bvh");
    ASSERT_EQ(slice.frames(), end - begin) << part.back();
    EXPECT_EQ(slice.channels, whole.channels.middleRows(begin, end - begin)) << part.back();
    EXPECT_EQ(slice.layout.frame_time_text, whole.layout.frame_time_text);
  };
  const long frames = whole.frames();
  ASSERT_GT(frames, 40);
  expect_slice({"--frames", "7:31"}, 7, 31);
  expect_slice({"--frames", ":5"}, 0, 5);
  expect_slice({"--frames", std::to_string(frames - 1) + ":"}, frames - 1, frames);
  expect_slice({"--frames", "0:" + std::to_string(frames)}, 0, frames);
  const double half = std::ceil(0.5 * whole.frame_rate - 1e-6);
  expect_slice({"--time", "0.5:"}, static_cast<long>(half), frames);
  expect_slice({"--time", ":0.5"}, 0, static_cast<long>(half));
  EXPECT_EQ(reprise({"extract", "lib.rpz", name, "-o", "-", "--frames",
                     "0:" + std::to_string(frames + 1)})
                .exit_code,
            2);
}

TEST_F(ExtractTest, ClipIsItsPartOfTheTake) {
  make_library();
  const auto clip = document({"list", "lib.rpz", "--clips"}).at("clips").at(0);
  const std::string id = clip.at("id");
  const long first = clip.at("first_frame");
  const long count = clip.at("frames");
  const std::string range = std::to_string(first) + ":" + std::to_string(first + count);
  EXPECT_EQ(output({"extract", "lib.rpz", id, "-o", "-"}),
            output({"extract", "lib.rpz", clip.at("take"), "--frames", range, "-o", "-"}));
  output({"extract", "lib.rpz", id, "-d", "clips"});
  const std::string file = clip.at("take").get<std::string>() + "_" + id + ".bvh";
  EXPECT_TRUE(fs::exists(folder() / "clips" / file));
}

TEST_F(ExtractTest, TreeOfNamesIsKept) {
  make_library();
  const auto extracted = document({"extract", "lib.rpz", "--all", "-d", "out/tree/"});
  EXPECT_EQ(extracted.at("extracted").size(), 4U);
  const auto files = files_below(folder() / "out/tree");
  ASSERT_EQ(files.size(), 4U);
  for (const std::string& name : take_names()) EXPECT_TRUE(files.contains(name + ".bvh")) << name;
  EXPECT_EQ(reprise({"extract", "lib.rpz", "--all", "-d", "out/tree"}).exit_code, 1);
  EXPECT_EQ(reprise({"extract", "lib.rpz", "--all", "-d", "out/tree", "--overwrite"}).exit_code, 0);
  EXPECT_EQ(files_below(folder() / "out/tree"), files);
}

// One take that has no place under the folder holds nobody else up.
TEST_F(ExtractTest, AllOthersAreWrittenBesideThoseThatCannotBe) {
  output({"synth", "takes", "--takes", "3", "--seconds", "1", "--subjects", "1"});
  const fs::path in = folder() / "in";
  fs::create_directories(in);
  fs::copy_file(folder() / "takes/s01/s01_01.bvh", in / "x.bvh");
  fs::copy_file(folder() / "takes/s01/s01_02.bvh", in / "x.bvh.bvh");
  fs::copy_file(folder() / "takes/s01/s01_03.bvh", in / "z.bvh");
  output({"ingest", "lib.rpz", "in"});
  // Of y a file and a folder are made.
  output({"ingest", "lib.rpz", "takes/s01/s01_01.bvh", "--prefix", "y.bvh"});
  fs::copy_file(folder() / "takes/s01/s01_02.bvh", folder() / "y.bvh");
  output({"ingest", "lib.rpz", "y.bvh"});
  output({"ingest", "lib.rpz", "takes/s01/s01_03.bvh", "--prefix", std::string(256, 'd')});

  const auto report = document({"extract", "lib.rpz", "--all", "-d", "out"}, 1);
  const auto files = files_below(folder() / "out");
  EXPECT_TRUE(files.contains("z.bvh"));
  EXPECT_EQ(files.size(), 2U);  // and one of y's
  EXPECT_EQ(report.at("extracted").size(), 2U);
  EXPECT_EQ(report.at("damaged").size(), 0U);
  std::set<std::string> named;
  for (const auto& entry : report.at("unwritten")) {
    named.insert(entry.at("id"));
    EXPECT_FALSE(entry.at("why").get<std::string>().empty());
  }
  EXPECT_EQ(named.size(), 4U);
  EXPECT_TRUE(named.contains("x"));
  EXPECT_TRUE(named.contains("x.bvh"));
  const Outcome told = reprise({"extract", "lib.rpz", "--all", "-d", "out", "--overwrite"});
  EXPECT_EQ(told.exit_code, 1);
  EXPECT_EQ(lines_of(told.err).size(), 4U) << told.err;
  // What was asked for by name is written in full or not at all.
  EXPECT_EQ(reprise({"extract", "lib.rpz", "x", "x.bvh", "-d", "both"}).exit_code, 1);
  EXPECT_FALSE(fs::exists(folder() / "both"));
}

TEST_F(ExtractTest, ALinkInTheTreeHoldsNobodyElseUp) {
  make_library();
  fs::create_directories(folder() / "out");
  fs::create_directories(folder() / "elsewhere");
  fs::create_directory_symlink(folder() / "elsewhere", folder() / "out" / "s01");
  const auto report = document({"extract", "lib.rpz", "--all", "-d", "out"}, 1);
  EXPECT_EQ(report.at("extracted").size() + report.at("unwritten").size(), 4U);
  EXPECT_GT(report.at("extracted").size(), 0U);
  EXPECT_GT(report.at("unwritten").size(), 0U);
  EXPECT_TRUE(fs::is_empty(folder() / "elsewhere"));
}

TEST_F(ExtractTest, AmcComesWithItsAsf) {
  make_library("amc");
  const std::string name = take_names().front();
  const auto entry = document({"extract", "lib.rpz", name, "-d", "out"}).at("extracted").at(0);
  const fs::path asf = entry.at("asf").get<std::string>();
  const fs::path source = folder() / "takes" / fs::path(name).parent_path() / asf.filename();
  EXPECT_EQ(read_file(folder() / asf), read_file(source));
  EXPECT_GT(read(entry.at("file").get<std::string>()).frames(), 0);
  // A second take of the same subject finds the skeleton there and leaves it.
  output({"extract", "lib.rpz", "--all", "-d", "out", "--overwrite"});
  const std::string text = output({"extract", "lib.rpz", name, "-o", "-"});
  EXPECT_EQ(text.find(":bonedata"), std::string::npos);
  EXPECT_EQ(text, read_file(folder() / entry.at("file").get<std::string>()));
}

TEST_F(ExtractTest, AFileIsNotNamedForAnotherFormat) {
  make_library("amc");
  const std::string name = take_names().front();
  const Outcome outcome = reprise({"extract", "lib.rpz", name, "-o", "take.BVH"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("cannot be written as bvh"), std::string::npos) << outcome.err;
  output({"extract", "lib.rpz", name, "-o", "take.AMC"});
}

TEST_F(ExtractTest, EndingsThatAreNotWrittenAreWrongUsage) {
  make_library();
  const std::string name = take_names().front();
  for (const char* file : {"x.fbx", "x.npz", "x.csv", "x.GLB", "x.asf", "x.txt", "out/x.c3d"}) {
    // Before the archive is looked at.
    for (const char* archive : {"lib.rpz", "nowhere.rpz"}) {
      const auto error = document({"extract", archive, name, "-o", file}, 2).at("error");
      EXPECT_EQ(error.at("file"), file);
      EXPECT_NE(error.at("advice").get<std::string>().find(".bvh or .amc"), std::string::npos);
    }
    EXPECT_FALSE(fs::exists(folder() / file)) << file;
  }
  const auto other = document({"extract", "lib.rpz", name, "-o", "x.amc"}, 2).at("error");
  EXPECT_EQ(other.at("advice"), "give a name that ends in .bvh");
  // A number behind a point is no format.
  for (const char* file : {"x", "x.BVH", "x_1.5", ".x"}) {
    output({"extract", "lib.rpz", name, "-o", file});
    EXPECT_EQ(read_file(folder() / file), output({"extract", "lib.rpz", name, "-o", "-"})) << file;
  }
}

TEST_F(ExtractTest, SkeletonOfAnotherIsNotReplaced) {
  make_library("amc");
  const std::string name = take_names().front();
  const auto entry = document({"extract", "lib.rpz", name, "-d", "out"}).at("extracted").at(0);
  const fs::path asf = folder() / entry.at("asf").get<std::string>();
  write_file(asf, "another skeleton");
  fs::remove(folder() / entry.at("file").get<std::string>());
  EXPECT_EQ(reprise({"extract", "lib.rpz", name, "-d", "out"}).exit_code, 1);
  EXPECT_EQ(read_file(asf), "another skeleton");
  EXPECT_FALSE(fs::exists(folder() / entry.at("file").get<std::string>()));
}

// One is named for the take, the other for its ASF: there is room for one of them.
TEST_F(ExtractTest, ASkeletonThatWasWrittenIsNotReplacedByAnother) {
  for (const char* seed : {"1", "2"}) {
    const std::string in = std::string("in") + seed;
    output({"synth", in, "--takes", "1", "--seconds", "1", "--subjects", "1", "--format", "amc",
            "--seed", seed});
    fs::create_directory(folder() / seed);
    fs::copy_file(folder() / in / "s01/s01.asf", folder() / seed / "walk.asf");
  }
  fs::copy_file(folder() / "in1/s01/s01_01.amc", folder() / "1/run.amc");
  fs::copy_file(folder() / "in2/s01/s01_01.amc", folder() / "2/walk.amc");
  ASSERT_NE(read_file(folder() / "1/walk.asf"), read_file(folder() / "2/walk.asf"));
  output({"ingest", "lib.rpz", "1"});
  output({"ingest", "lib.rpz", "2"});
  const Outcome outcome = reprise({"extract", "lib.rpz", "--all", "-d", "out", "--overwrite"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("two skeletons"), std::string::npos) << outcome.err;
  EXPECT_EQ(read_file(folder() / "out/walk.asf"), read_file(folder() / "1/walk.asf"));
}

TEST_F(ExtractTest, LinkInTheFolderIsNotFollowed) {
  make_library();
  const std::string name = take_names().front();
  const auto slash = name.find('/');
  ASSERT_NE(slash, std::string::npos) << name;
  fs::create_directories(folder() / "out");
  fs::create_directories(folder() / "elsewhere");
  fs::create_directory_symlink(folder() / "elsewhere", folder() / "out" / name.substr(0, slash));
  EXPECT_EQ(reprise({"extract", "lib.rpz", name, "-d", "out"}).exit_code, 1);
  EXPECT_TRUE(fs::is_empty(folder() / "elsewhere"));
}

// A page of the archive at a time: what comes out is what was stored, the rest is named.
TEST_F(ExtractTest, WhatIsWholeComesOutOfADamagedArchive) {
  make_library({"--takes", "3", "--seconds", "2", "--subjects", "1"}, {"--fidelity", "exact"});
  const std::vector<std::string> names = take_names();
  const std::string whole = read_file(folder() / "lib.rpz");
  constexpr std::size_t tried = 10;
  std::size_t in_part = 0;
  for (std::size_t n = 1; n <= tried; ++n) {
    std::string damaged = whole;
    damaged[whole.size() / (tried + 1) * n] ^= 1;
    write_file(folder() / "damaged.rpz", damaged);
    const std::string out = "out" + std::to_string(n);
    const Outcome outcome = reprise({"extract", "damaged.rpz", "--all", "-d", out});
    std::size_t written = 0;
    for (const std::string& name : names) {
      const fs::path file = folder() / out / (name + ".bvh");
      const bool there = fs::exists(file);
      written += there;
      EXPECT_TRUE(!there || read_file(file) == read_file(folder() / "takes" / (name + ".bvh")));
    }
    EXPECT_EQ(outcome.exit_code, written == names.size() ? 0 : 4) << outcome.err;
    EXPECT_EQ(outcome.err.empty(), written == names.size()) << outcome.err;
    in_part += written > 0 && written < names.size();
  }
  EXPECT_GT(in_part, 0u);
}

// An AMC need not have a line for each bone: those it leaves out cannot make up for others.
TEST_F(ExtractTest, BoundsHoldInTheFileOfAnAmcThatLeavesBonesOut) {
  output({"synth", "in", "--takes", "2", "--seconds", "2", "--subjects", "1", "--format", "amc"});
  std::string text;
  for (const std::string& line : lines_of(read_file(folder() / "in/s01/s01_01.amc"))) {
    if (!line.starts_with("lfemur ") && !line.starts_with("rhand ")) text += line + "\n";
  }
  write_file(folder() / "in/s01/s01_01.amc", text);
  for (const auto& [fidelity, limit] :
       {std::pair{"preview", 20.0}, {"standard", 10.0}, {"fine", 1.0}}) {
    const std::string archive = std::string(fidelity) + ".rpz";
    output({"ingest", archive, "in", "--fidelity", fidelity});
    output({"extract", archive, "s01_01", "-o", "out.amc", "--overwrite"});
    const auto apart =
        document({"compare", "in/s01/s01_01.amc", "out.amc", "--asf", "in/s01/s01.asf"});
    const char* measure = fidelity == std::string("preview") ? "mean_mm" : "max_mm";
    EXPECT_LE(apart.at(measure).get<double>(), limit) << fidelity;
    const auto told = document({"info", archive, "s01_01"}).at("take").at("error_mm");
    EXPECT_NEAR(apart.at("max_mm").get<double>(), told.at("max").get<double>(), 0.01);
    output({"verify", archive, "--against", "in"});
  }
}

TEST_F(ExtractTest, ComparisonSaysWhatDiffers) {
  const auto bvh = [](const std::string& joint, const std::string& time) {
    return "HIERARCHY\nROOT " + joint +
           "\n{\nOFFSET 0 0 0\nCHANNELS 1 Xposition\n}\nMOTION\nFrames: 1\nFrame Time: " + time +
           "\n1\n";
  };
  write_file(folder() / "a.bvh", bvh("hips", "0.0083333"));
  write_file(folder() / "names.bvh", bvh("pelvis", "0.00833"));
  write_file(folder() / "rate.bvh", bvh("hips", "0.01"));
  EXPECT_EQ(reprise({"compare", "a.bvh", "a.bvh"}).err, "");
  const Outcome names = reprise({"compare", "a.bvh", "names.bvh"});
  EXPECT_EQ(names.exit_code, 0);
  EXPECT_NE(names.err.find("'hips' and 'pelvis'"), std::string::npos) << names.err;
  EXPECT_EQ(lines_of(names.err).size(), 1U) << "one rate in other decimals is one";
  const Outcome rate = reprise({"compare", "a.bvh", "rate.bvh"});
  EXPECT_EQ(rate.exit_code, 0);
  EXPECT_NE(rate.err.find("and 100 Hz"), std::string::npos) << rate.err;
}

TEST_F(ExtractTest, ComparisonReadsStdin) {
  make_library();
  const std::string name = take_names().front();
  output({"extract", "lib.rpz", name, "-o", "x.bvh"});
  const std::string source = "takes/" + name + ".bvh";
  const Outcome piped =
      reprise({"compare", source, "-", "--json"}, {.environment = {}, .input = "x.bvh"});
  EXPECT_EQ(piped.exit_code, 0) << piped.err;
  EXPECT_EQ(piped.out, output({"compare", source, "x.bvh", "--json"}));
}

}  // namespace
}  // namespace reprise::cli
