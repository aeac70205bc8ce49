// How the numbers of files are meant: units of length and up axes, guessed, given and recorded.
#include <cmath>

#include "cli/command_runner.h"
#include "edited_motion.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

using nlohmann::json;

class ReadingTest : public CommandTest {
 protected:
  static constexpr int takes = 4;

  /// Writes synthetic takes, each changed by `edit`, into a folder.
  template <class Edit>
  void write_takes(const std::string& name, const Edit& edit) const {
    int number = 0;
    for (const Take& take : edited::synthetic_takes(takes, 3)) {
      write_take(fmt::format("{}/t{}.bvh", name, number++), edit(take));
    }
  }

  void write_take(const std::string& name, const Take& take) const {
    fs::create_directories((folder() / name).parent_path());
    write_file(folder() / name, write_bvh(take));
  }

  /// Distances of a search, by take.
  std::map<std::string, double> distances(const std::vector<std::string>& arguments) const {
    std::map<std::string, double> found;
    const json results = document(arguments).at("results");
    for (const json& result : results) {
      found[result.at("take")] = result.at("distance_mm");
    }
    return found;
  }

  static Take as_it_is(const Take& take) { return take; }

  json listed(const std::string& archive) const { return document({"list", archive}).at("takes"); }

  void expect_near(const std::map<std::string, double>& found,
                   const std::map<std::string, double>& expected, const std::string& what) const {
    ASSERT_EQ(found.size(), expected.size()) << what;
    for (const auto& [take, distance] : expected) {
      EXPECT_NEAR(found.at(take), distance, 1.0) << what << " " << take;
    }
  }

  const std::vector<std::string> usual_search_ = {"search", "usual.rpz", "--id", "t1"};
};

TEST_F(ReadingTest, AUnitThatNobodySaysIsGuessedAndSaid) {
  write_takes("usual", as_it_is);
  output({"ingest", "usual.rpz", "usual", "--fidelity", "fine"});
  const auto expected = distances(usual_search_);
  ASSERT_EQ(expected.size(), takes - 1u);
  for (const double unit : {1000.0, 1.0, 25.4, 25.4 / 0.45, 100.0}) {
    const std::string name = fmt::format("u{:.0f}", unit);
    write_takes(name, [&](const Take& take) { return edited::in_unit(take, unit); });
    const json report = document({"ingest", name + ".rpz", name, "--fidelity", "fine"});
    ASSERT_EQ(report.at("assumed_units").size(), 1u);
    EXPECT_NEAR(report.at("assumed_units")[0].at("unit_mm"), unit, 1e-9);
    EXPECT_EQ(report.at("assumed_units")[0].at("takes"), takes);
    EXPECT_GT(report.at("assumed_units")[0].at("height_mm")[0], 1400);
    for (const json& take : listed(name + ".rpz")) {
      EXPECT_NEAR(take.at("unit_mm"), unit, 1e-9);
      EXPECT_TRUE(take.at("unit_assumed"));
      EXPECT_LE(take.at("error_mm").at("max"), 1.0);
    }
    expect_near(distances({"search", name + ".rpz", "--id", "t1"}), expected, name);
    // A file in yet another unit finds its take.
    const auto self = distances({"search", name + ".rpz", "--like", "usual/t1.bvh", "--top", "1"});
    ASSERT_TRUE(self.contains("t1")) << name;
    EXPECT_LT(self.at("t1"), 1.0) << name;
    EXPECT_TRUE(document({"verify", name + ".rpz", "--against", name}).at("ok"));
    EXPECT_LT(document({"compare", "usual/t1.bvh", name + "/t1.bvh"}).at("max_mm"), 0.1);
  }
}

TEST_F(ReadingTest, ABoundIsKeptInTrueMillimetres) {
  const Take take = edited::in_unit(edited::synthetic_takes(1, 3)[0], 1000);
  write_take("metres/t.bvh", take);
  output({"ingest", "m.rpz", "metres"});
  output({"extract", "m.rpz", "t", "-o", "t.bvh"});
  const json stored = listed("m.rpz")[0].at("error_mm");
  const json measured = document({"compare", "metres/t.bvh", "t.bvh", "--unit-mm", "1000"});
  EXPECT_GT(measured.at("max_mm"), 1.0);
  EXPECT_LE(measured.at("max_mm"), 10.0);
  EXPECT_NEAR(measured.at("max_mm"), stored.at("max").get<double>(), 0.3);
}

TEST_F(ReadingTest, AFolderOfMixedUnitsIsOneIngest) {
  const std::vector<Take> motions = edited::synthetic_takes(3, 2);
  write_take("mixed/a.bvh", motions[0]);
  write_take("mixed/b.bvh", edited::in_unit(motions[1], 1000));
  write_take("mixed/c.bvh", edited::in_unit(motions[2], 25.4));
  write_file(folder() / "rows.csv", "take,Unit_MM,fps\na,20,\nc,,\n");
  const Outcome outcome = reprise({"ingest", "lib.rpz", "mixed", "--metadata", "rows.csv"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("25.4 mm, guessed for 1 take"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("1000 mm, guessed for 1 take"), std::string::npos) << outcome.out;
  const json list = listed("lib.rpz");
  EXPECT_EQ(list[0].at("unit_mm"), 20);
  EXPECT_FALSE(list[0].at("unit_assumed"));
  EXPECT_EQ(list[1].at("unit_mm"), 1000);
  EXPECT_EQ(list[2].at("unit_mm"), 25.4);
  EXPECT_TRUE(list[2].at("unit_assumed"));
  // A row that says another unit than is stored is told, and taken with --replace.
  write_file(folder() / "rows.csv", "take,unit_mm\nb,500\n");
  EXPECT_EQ(document({"ingest", "lib.rpz", "mixed", "--metadata", "rows.csv"}).at("other_reading"),
            json({"b"}));
  output({"ingest", "lib.rpz", "mixed", "--metadata", "rows.csv", "--replace"});
  EXPECT_EQ(listed("lib.rpz")[1].at("unit_mm"), 500);
}

TEST_F(ReadingTest, TheFrameRateOfAnAmcMayStandInTheMetadata) {
  output({"synth", "amc", "--takes", "2", "--seconds", "2", "--subjects", "1", "--format", "amc"});
  write_file(folder() / "rows.csv", "take,fps\ns01_01,60\n");
  output({"ingest", "lib.rpz", "amc", "--metadata", "rows.csv"});
  EXPECT_EQ(listed("lib.rpz")[0].at("frame_rate"), 60);
  EXPECT_EQ(listed("lib.rpz")[1].at("frame_rate"), 120);
  EXPECT_FALSE(document({"info", "lib.rpz", "s01_01"}).at("take").at("frame_rate_assumed"));
}

TEST_F(ReadingTest, ANumberInTheMetadataThatMakesNoSenseIsToldWithItsLine) {
  write_takes("takes", as_it_is);
  for (const std::string cell : {"ten", "0", "-5", "1e9", "nan", "10 mm"}) {
    for (const std::string column : {"unit_mm", "fps"}) {
      write_file(folder() / "rows.csv", fmt::format("take,{}\nt1,10\nt2,{}\n", column, cell));
      const Outcome outcome = reprise({"ingest", "lib.rpz", "takes", "--metadata", "rows.csv"});
      EXPECT_EQ(outcome.exit_code, 1) << cell;
      EXPECT_NE(outcome.err.find("rows.csv:3"), std::string::npos) << outcome.err;
      EXPECT_NE(outcome.err.find(column), std::string::npos) << outcome.err;
    }
  }
  EXPECT_FALSE(fs::exists(folder() / "lib.rpz"));
}

TEST_F(ReadingTest, TakesThatComeLaterHaveTheUnitOfTheirText) {
  const std::vector<Take> motions = edited::synthetic_takes(2, 2);
  write_take("first/a.bvh", motions[0]);
  write_take("later/b.bvh", motions[1]);
  output({"ingest", "lib.rpz", "first", "--unit-mm", "12", "--up", "-z"});
  output({"ingest", "lib.rpz", "later"});
  const json list = listed("lib.rpz");
  EXPECT_FALSE(list[0].at("unit_assumed"));
  EXPECT_EQ(list[0].at("up"), "-z");
  EXPECT_EQ(list[1].at("unit_mm"), 12);
  EXPECT_TRUE(list[1].at("unit_assumed"));
  EXPECT_EQ(list[1].at("up"), "-z");
  EXPECT_TRUE(list[1].at("up_assumed"));
  // What is stored anew without another word keeps what was said of it.
  output({"ingest", "lib.rpz", "first", "--replace", "--fidelity", "fine"});
  EXPECT_EQ(listed("lib.rpz")[0].at("unit_mm"), 12);
  EXPECT_FALSE(listed("lib.rpz")[0].at("unit_assumed"));
}

TEST_F(ReadingTest, AFileIsReadAsTheTakesOfItsTextAre) {
  // Who lies down all the time does not say what is up; the others do.
  Take lying = edited::synthetic_takes(1, 2)[0];
  const Joint root = lying.skeleton->joints[0];
  for (std::size_t c = 0; c < root.channels.size(); ++c) {
    if (!is_rotation(root.channels[c])) continue;
    const double degrees = root.channels[c] == Channel::x_rotation ? 90 : 0;
    lying.channels.col(root.first_channel + static_cast<Eigen::Index>(c)).setConstant(degrees);
  }
  write_takes("lib", as_it_is);
  write_take("lib/lying.bvh", lying);
  output({"ingest", "lib.rpz", "lib", "--fidelity", "fine"});
  for (const json& take : listed("lib.rpz")) EXPECT_EQ(take.at("up"), "y") << take.at("name");
  const auto found = distances({"search", "lib.rpz", "--like", "lib/lying.bvh", "--top", "1"});
  ASSERT_TRUE(found.contains("lying"));
  EXPECT_LT(found.at("lying"), 1.0);
}

TEST_F(ReadingTest, AUnitThatNothingSaysIsTold) {
  const Take take = edited::renamed(edited::synthetic_takes(1, 2)[0], [](const std::string& name) {
    return fmt::format("Prop{}{}", name.size(), name.substr(0, 1));
  });
  write_take("props/a.bvh", edited::with_skeleton(take, [](Skeleton& skeleton) {
               for (Joint& joint : skeleton.joints) joint.offset.x() = 3;
             }));
  const Outcome outcome = reprise({"ingest", "lib.rpz", "props"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("--unit-mm"), std::string::npos) << outcome.err;
  EXPECT_EQ(listed("lib.rpz")[0].at("unit_mm"), 10);
  EXPECT_TRUE(listed("lib.rpz")[0].at("unit_assumed"));
  const Outcome said = reprise({"ingest", "other.rpz", "props", "--unit-mm", "25.4"});
  EXPECT_EQ(said.err.find("--unit-mm"), std::string::npos) << said.err;
}

TEST_F(ReadingTest, AnAsfThatMakesABodyImplausibleIsTold) {
  output({"synth", "amc", "--takes", "2", "--seconds", "2", "--subjects", "1", "--format", "amc"});
  EXPECT_EQ(document({"ingest", "good.rpz", "amc"}).at("implausible_units"), json::array());
  for (const auto& [name, text] : files_below(folder() / "amc")) {
    if (!name.ends_with(".asf")) continue;
    const auto at = text.find("length 0.45");
    ASSERT_NE(at, std::string::npos);
    write_file(folder() / "amc" / name,
               fmt::format("{}length 0.04{}", text.substr(0, at), text.substr(at + 11)));
  }
  const Outcome outcome = reprise({"ingest", "giants.rpz", "amc"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("taller than 2.3 m"), std::string::npos) << outcome.err;
  EXPECT_EQ(document({"ingest", "giants2.rpz", "amc"}).at("implausible_units").size(), 2u);
}

TEST_F(ReadingTest, TheUpAxisIsFoundAndMakesNoDifference) {
  write_takes("usual", as_it_is);
  output({"ingest", "usual.rpz", "usual", "--fidelity", "fine"});
  const auto expected = distances(usual_search_);
  const std::string part = "1.5";
  const json repeats =
      document({"repeats", "usual.rpz", "t1", "--from", "0.5", "--to", part}).at("groups");
  for (const UpAxis up : edited::every_up) {
    const std::string axis(up_axis_name(up)), name = "up_" + axis;
    write_takes(name, [&](const Take& take) { return edited::turned(take, up); });
    output({"ingest", name + ".rpz", name, "--fidelity", "fine"});
    for (const json& take : listed(name + ".rpz")) {
      EXPECT_EQ(take.at("up"), axis);
      EXPECT_TRUE(take.at("up_assumed"));
    }
    expect_near(distances({"search", name + ".rpz", "--id", "t1"}), expected, name);
    const auto self = distances({"search", name + ".rpz", "--like", "usual/t1.bvh", "--top", "1"});
    ASSERT_TRUE(self.contains("t1")) << name;
    EXPECT_LT(self.at("t1"), 1.0) << name;
    EXPECT_TRUE(document({"verify", name + ".rpz", "--against", name}).at("ok"));
    const json found =
        document({"repeats", name + ".rpz", "t1", "--from", "0.5", "--to", part}).at("groups");
    ASSERT_EQ(found.size(), repeats.size()) << name;
    for (std::size_t g = 0; g < found.size(); ++g) {
      EXPECT_EQ(found[g].at("occurrences").size(), repeats[g].at("occurrences").size()) << name;
    }
    const json skate = document({"compare", name + "/t1.bvh", name + "/t1.bvh"});
    const json usual = document({"compare", "usual/t1.bvh", "usual/t1.bvh"});
    EXPECT_NEAR(skate.at("foot_skate_mm_s").at("original"),
                usual.at("foot_skate_mm_s").at("original").get<double>(), 0.01)
        << name;
  }
}

TEST_F(ReadingTest, TakesWithOtherAxesUpAreOfOneArchive) {
  const std::vector<Take> motions = edited::synthetic_takes(2, 3);
  write_take("lib/y.bvh", motions[0]);
  write_take("lib/z.bvh", edited::turned(motions[0], UpAxis::z));
  write_take("lib/other.bvh", edited::turned(motions[1], UpAxis::minus_x));
  output({"ingest", "lib.rpz", "lib", "--fidelity", "fine"});
  const auto found = distances({"search", "lib.rpz", "--id", "z", "--top", "1"});
  ASSERT_TRUE(found.contains("y"));
  EXPECT_LT(found.at("y"), 1.0);
  EXPECT_TRUE(document({"verify", "lib.rpz", "--against", "lib"}).at("ok"));
}

TEST_F(ReadingTest, AGivenUpAxisComesFirst) {
  write_takes("takes", as_it_is);
  output({"ingest", "lib.rpz", "takes", "--up", "z"});
  EXPECT_EQ(listed("lib.rpz")[0].at("up"), "z");
  EXPECT_FALSE(listed("lib.rpz")[0].at("up_assumed"));
  EXPECT_EQ(document({"ingest", "lib.rpz", "takes", "--up", "-y"}).at("other_reading").size(),
            static_cast<std::size_t>(takes));
  output({"ingest", "lib.rpz", "takes", "--up", "-y", "--replace"});
  EXPECT_EQ(listed("lib.rpz")[0].at("up"), "-y");
  EXPECT_TRUE(document({"verify", "lib.rpz", "--against", "takes"}).at("ok"));
  for (const std::string axis : {"w", "", "yy", "+y"}) {
    EXPECT_EQ(reprise({"ingest", "lib.rpz", "takes", "--up", axis}).exit_code, 2) << axis;
  }
  EXPECT_EQ(reprise({"search", "lib.rpz", "--id", "t1", "--up", "y"}).exit_code, 2);
}

TEST_F(ReadingTest, TheContentDoesNotDependOnOrderOrThreads) {
  const std::vector<Take> motions = edited::synthetic_takes(3, 2);
  write_take("a/t0.bvh", edited::in_unit(motions[0], 1000));
  write_take("b/t1.bvh", edited::in_unit(motions[1], 1000));
  write_take("c/t2.bvh", edited::turned(motions[2], UpAxis::z));
  output({"ingest", "one.rpz", "a", "b", "c", "--jobs", "1"});
  output({"ingest", "two.rpz", "c", "b", "a", "--jobs", "2"});
  EXPECT_EQ(content_digest("one.rpz"), content_digest("two.rpz"));
}

TEST_F(ReadingTest, InfoSaysHowABodyWasFound) {
  int number = 0;
  write_take("lib/a.bvh", edited::renamed(edited::synthetic_takes(1, 2)[0], [&](const auto& name) {
               return name == "Head" ? name : fmt::format("J{}", number++);
             }));
  write_file(folder() / "map.txt", "chest = J11\n");
  output({"ingest", "lib.rpz", "lib"});
  const json by =
      document({"info", "lib.rpz", "a", "--joint-map", "map.txt"}).at("take").at("body_found_by");
  EXPECT_EQ(by.size(), 17u);
  EXPECT_EQ(by.at("head"), "name");
  EXPECT_EQ(by.at("chest"), "map");
  EXPECT_EQ(by.at("knee_left"), "hierarchy");
  EXPECT_NE(output({"info", "lib.rpz", "a"}).find("by hierarchy"), std::string::npos);
}

}  // namespace
}  // namespace reprise::cli
