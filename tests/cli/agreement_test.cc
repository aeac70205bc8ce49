// What one document says of an archive is what the others say.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "cli/command_runner.h"

namespace reprise::cli {
namespace {

using nlohmann::json;

class AgreementTest : public CommandTest {
 protected:
  AgreementTest() {
    make_library({"--takes", "6", "--seconds", "5", "--subjects", "2"}, {});
    takes_ = document({"list", "lib.rpz"}).at("takes");
    clips_ = document({"list", "lib.rpz", "--clips"}).at("clips");
    stats_ = document({"stats", "lib.rpz"});
  }

  template <typename Number>
  Number sum_of(const char* field) const {
    Number sum = 0;
    for (const json& take : takes_) sum += take.at(field).get<Number>();
    return sum;
  }

  json takes_, clips_, stats_;
};

TEST_F(AgreementTest, StatisticsAreThoseOfTheTakes) {
  EXPECT_EQ(stats_.at("takes"), takes_.size());
  EXPECT_EQ(stats_.at("frames"), sum_of<long>("frames"));
  EXPECT_EQ(stats_.at("raw_bytes"), sum_of<long>("raw_bytes"));
  EXPECT_NEAR(stats_.at("seconds").get<double>(), sum_of<double>("seconds"), 1e-6);
  std::set<std::string> subjects;
  std::map<std::string, std::size_t> tiers;
  for (const json& take : takes_) {
    subjects.insert(take.at("subject").get<std::string>());
    ++tiers[take.at("fidelity").get<std::string>()];
  }
  EXPECT_EQ(stats_.at("subjects"), subjects.size());
  EXPECT_EQ(stats_.at("fidelity"), json(tiers));
  const json info = document({"info", "lib.rpz"});
  EXPECT_EQ(info.at("stats"), stats_);
  EXPECT_EQ(info.at("subjects"), json(subjects));
  const json verified = document({"verify", "lib.rpz"});
  EXPECT_EQ(verified.at("takes"), takes_.size());
  EXPECT_EQ(verified.at("clips"), clips_.size());
  EXPECT_EQ(verified.at("error_mm"), stats_.at("error_mm"));
}

TEST_F(AgreementTest, ClipsFollowOneAnotherAndAddUpToTheirTake) {
  for (const json& take : takes_) {
    const double rate = take.at("frame_rate");
    long frame = 0, bytes = 0;
    for (const json& clip : clips_) {
      if (clip.at("take") != take.at("name")) continue;
      EXPECT_EQ(clip.at("first_frame"), frame) << clip;
      EXPECT_NEAR(clip.at("start").get<double>(), static_cast<double>(frame) / rate, 1e-9);
      frame += clip.at("frames").get<long>();
      EXPECT_NEAR(clip.at("end").get<double>(), static_cast<double>(frame) / rate, 1e-9);
      bytes += clip.at("bytes").get<long>();
    }
    EXPECT_EQ(take.at("frames"), frame);
    EXPECT_EQ(take.at("payload_bytes"), bytes);
  }
}

TEST_F(AgreementTest, PrimariesAreWhatRepeatedClipsName) {
  std::map<std::string, std::size_t> kinds = {{"primary", 0}, {"repeated", 0}, {"unique", 0}};
  std::set<std::string> primaries, named;
  for (const json& clip : clips_) {
    const std::string kind = clip.at("kind");
    ++kinds[kind];
    if (kind == "primary") primaries.insert(clip.at("id").get<std::string>());
    if (kind == "repeated") named.insert(clip.at("primary").get<std::string>());
  }
  ASSERT_FALSE(named.empty()) << "a library without repeats shows nothing here";
  EXPECT_EQ(named, primaries);
  EXPECT_EQ(stats_.at("clips"), json(kinds));
}

TEST_F(AgreementTest, OccurrencesAreWithinTheirTakesAndClips) {
  std::map<std::string, json> takes;
  for (const json& take : takes_) takes[take.at("name")] = take;
  const json groups = document({"repeats", "lib.rpz"}).at("groups");
  ASSERT_FALSE(groups.empty());
  for (const json& group : groups) {
    EXPECT_EQ(group.at("occurrences").at(0).at("distance_mm"), 0);
    for (const json& occurrence : group.at("occurrences")) {
      const json& take = takes.at(occurrence.at("take"));
      EXPECT_EQ(occurrence.at("subject"), take.at("subject"));
      const double start = occurrence.at("start"), end = occurrence.at("end");
      EXPECT_LE(0, start);
      EXPECT_LT(start, end);
      EXPECT_LE(end, take.at("seconds").get<double>() + 1e-9);
      const auto clip = std::ranges::find_if(clips_, [&](const json& one) {
        return one.at("id") == occurrence.at("clip") && one.at("take") == occurrence.at("take");
      });
      ASSERT_NE(clip, clips_.end()) << occurrence;
      EXPECT_LT(std::max(start, clip->at("start").get<double>()),
                std::min(end, clip->at("end").get<double>()))
          << occurrence;
    }
  }
}

}  // namespace
}  // namespace reprise::cli
