// repeats: what it finds in a library whose repeats are known, and what it refuses.
#include <algorithm>

#include "cli/command_runner.h"

namespace reprise::cli {
namespace {

using nlohmann::json;

class RepeatsCommandTest : public CommandTest {
 protected:
  void SetUp() override {
    make_library({"--takes", "8", "--seconds", "10", "--subjects", "2"}, {"--fidelity", "preview"});
  }

  static std::string stem(const std::string& path) {
    const std::string name = path.substr(path.rfind('/') + 1);
    return name.substr(0, name.rfind('.'));
  }

  static bool is_at(const json& occurrence, const json& truth) {
    if (stem(truth["file"]) != stem(occurrence["take"].get<std::string>() + ".x")) return false;
    const double start = occurrence["start"], end = occurrence["end"];
    const double true_start = truth["start_s"], true_end = truth["end_s"];
    const double common = std::min(end, true_end) - std::max(start, true_start);
    return common >= 0.5 * (std::max(end, true_end) - std::min(start, true_start));
  }

  static bool holds(const json& group, const json& truth) {
    return std::ranges::any_of(group["occurrences"],
                               [&](const json& o) { return is_at(o, truth); });
  }
};

TEST_F(RepeatsCommandTest, FindsWhatTheSynthesiserRepeatedClipByClip) {
  // Half of the pairs are found here (docs/findings); those that are lost differ most in speed.
  const json truth = json::parse(read_file(folder() / "takes" / "truth.json"));
  int pairs = 0, hits = 0;
  for (const json& known : truth) {
    for (const json& asked : known) {
      const std::string take = asked["file"].get<std::string>();
      const json groups =
          document({"repeats", "lib.rpz", take.substr(0, take.rfind('.')), "--from",
                    asked["start_s"].dump(), "--to", asked["end_s"].dump()})["groups"];
      for (const json& other : known) {
        if (other == asked) continue;
        ++pairs;
        hits += std::ranges::any_of(groups, [&](const json& g) { return holds(g, other); });
      }
    }
  }
  ASSERT_GT(pairs, 0);
  EXPECT_GE(hits, 0.4 * pairs);
}

TEST_F(RepeatsCommandTest, OccurrencesHaveThePromisedFields) {
  const json groups = document({"repeats", "lib.rpz"})["groups"];
  ASSERT_FALSE(groups.empty());
  for (const json& group : groups) {
    EXPECT_TRUE(group["id"].is_string());
    ASSERT_GE(group["occurrences"].size(), 2u);
    EXPECT_EQ(group["occurrences"][0]["distance_mm"], 0.0);
    for (const json& o : group["occurrences"]) {
      EXPECT_EQ(o.size(), 6u);
      EXPECT_TRUE(o["clip"].is_string() && o["take"].is_string() && o["subject"].is_string());
      EXPECT_LT(o["start"].get<double>(), o["end"].get<double>());
    }
  }
}

TEST_F(RepeatsCommandTest, APartOfATakeIsTheFirstOfItsGroup) {
  const std::string take = take_names()[0];
  const json groups =
      document({"repeats", "lib.rpz", take, "--from", "1", "--to", "2.5"})["groups"];
  ASSERT_LE(groups.size(), 1u);
  if (groups.empty()) return;
  EXPECT_EQ(groups[0]["occurrences"][0]["take"], take);
  EXPECT_NEAR(groups[0]["occurrences"][0]["start"].get<double>(), 1, 0.02);
  EXPECT_NEAR(groups[0]["occurrences"][0]["end"].get<double>(), 2.5, 0.02);
}

TEST_F(RepeatsCommandTest, FiltersHold) {
  const std::string take = take_names()[0];
  const json of_take = document({"repeats", "lib.rpz", take})["groups"];
  for (const json& group : of_take) {
    EXPECT_TRUE(std::ranges::any_of(group["occurrences"],
                                    [&](const json& o) { return o["take"] == take; }));
  }
  const json across = document({"repeats", "lib.rpz", "--across-subjects"})["groups"];
  for (const json& group : across) {
    EXPECT_TRUE(std::ranges::any_of(group["occurrences"], [&](const json& o) {
      return o["subject"] != group["occurrences"][0]["subject"];
    }));
  }
  const json long_ones = document({"repeats", "lib.rpz", "--min-seconds", "1.5"})["groups"];
  for (const json& group : long_ones) {
    for (const json& o : group["occurrences"]) {
      EXPECT_GE(o["end"].get<double>() - o["start"].get<double>(), 1.5);
    }
  }
}

TEST_F(RepeatsCommandTest, RefusesWhatMakesNoSense) {
  EXPECT_EQ(reprise({"repeats", "lib.rpz", "--from", "1"}).exit_code, 2);
  const std::string take = take_names()[0];
  EXPECT_EQ(reprise({"repeats", "lib.rpz", take, "--from", "2", "--to", "1"}).exit_code, 2);
  EXPECT_EQ(reprise({"repeats", "lib.rpz", take, "--from", "1", "--to", "1.02"}).exit_code, 2);
  EXPECT_EQ(reprise({"repeats", "lib.rpz", take, "--to", "1000"}).exit_code, 2);
  EXPECT_EQ(reprise({"repeats", "lib.rpz", "no-such-take"}).exit_code, 7);
}

}  // namespace
}  // namespace reprise::cli
