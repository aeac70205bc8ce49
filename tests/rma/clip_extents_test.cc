// Which clips the paths between near places cover.
#include "rma/clip_extents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "rma/made_up_postures.h"
#include "rma/repeat_groups.h"

namespace reprise {
namespace {

const RepeatConstants constants;

TEST(TracedPaths, GoThroughPairsThatOthersGoOnFrom) {
  const PostureLibrary library({made_up_take(1, 0, 4), made_up_take(1, 0, 4)}, constants);
  const std::vector<NearPair> alone{{0, 20, 1, 20}}, back{{0, 20, 1, 20}, {0, 23, 1, 17}},
      late{{0, 20, 1, 20}, {0, 40, 1, 40}}, on{{0, 20, 1, 20}, {0, 23, 1, 24}};
  EXPECT_TRUE(trace_paths(library, alone, constants).empty());
  EXPECT_TRUE(trace_paths(library, back, constants).empty());
  EXPECT_TRUE(trace_paths(library, late, constants).empty());
  EXPECT_FALSE(trace_paths(library, on, constants).empty());
  RepeatConstants all = constants;
  all.next_near_s = 0;
  EXPECT_EQ(trace_paths(library, alone, all).size(), 1u);
}

TEST(TracedPaths, AreNotTracedAgainFromPairsOnThem) {
  const PostureLibrary library({made_up_take(1, 0, 4), made_up_take(1, 0, 4)}, constants);
  const std::vector<NearPair> pairs{{0, 20, 1, 20}, {0, 23, 1, 24}, {0, 26, 1, 25}};
  EXPECT_EQ(trace_paths(library, pairs, constants).size(), 1u);
}

TEST(ClipExtents, OfAMotionThatGoesOnAreOnePeriod) {
  const PostureMatrix period = made_up_take(1, 0, 2);
  const PostureLibrary library({joined({period, period, period})}, constants);
  const std::vector<NearPair> pairs{{0, 5, 0, 35}, {0, 8, 0, 38}};
  const std::vector<ClipExtent> extents = find_clip_extents(library, pairs, constants);
  ASSERT_EQ(extents.size(), 2u);
  EXPECT_EQ(extents[0].begin, 0);
  EXPECT_EQ(extents[0].end, 30);
  EXPECT_EQ(extents[1].begin, 30);
  EXPECT_EQ(extents[1].end, 60);
}

/// Whether a motion may go on from one pair to the other within so many samples.
bool goes_on(const NearPair& from, const NearPair& to, long most) {
  const long x = to.sample - from.sample, y = to.other_sample - from.other_sample;
  return x > 0 && y > 0 && x <= 3 * y && y <= 3 * x && std::min(x, y) <= most;
}

TEST(TracedPaths, LeaveOutThePairsThatEveryOtherOneSaysAreAlone) {
  const PostureLibrary library({made_up_take(1, 0, 20), made_up_take(1, 0, 20)}, constants);
  const long most = std::lround(constants.next_near_s * constants.rate);
  RepeatConstants all = constants;
  all.next_near_s = 0;
  std::mt19937 random(7);
  for (const int count : {2, 30, 300}) {
    std::vector<NearPair> pairs, going_on;
    for (int i = 0; i < count; ++i) {
      const auto sample = static_cast<std::int32_t>(random() % 290);
      pairs.push_back({0, sample, 1, sample + static_cast<std::int32_t>(random() % 11)});
    }
    std::ranges::copy_if(pairs, std::back_inserter(going_on), [&](const NearPair& pair) {
      return std::ranges::any_of(pairs, [&](const NearPair& other) {
        return goes_on(pair, other, most) || goes_on(other, pair, most);
      });
    });
    const auto traced = trace_paths(library, pairs, constants);
    const auto expected = trace_paths(library, going_on, all);
    ASSERT_EQ(traced.size(), expected.size()) << count;
    for (std::size_t i = 0; i < traced.size(); ++i) {
      EXPECT_EQ(traced[i].path.pixels.front().x, expected[i].path.pixels.front().x);
      EXPECT_EQ(traced[i].path.pixels.size(), expected[i].path.pixels.size());
    }
  }
}

/// Everything is similar to everything: a take that only trembles.
TEST(TracedPaths, OfALongTakeThatOnlyTremblesAreNotMoreTheLongerItIs) {
  const auto pixels_a_sample = [](long rows) {
    PostureMatrix take(rows, 12);
    for (long s = 0; s < rows; ++s) {
      for (int c = 0; c < 12; ++c) {
        take(s, c) = static_cast<float>(3 * scrambled(static_cast<int>(s), c));
      }
    }
    const PostureLibrary library({take, take}, constants);
    std::vector<NearPair> pairs;
    for (std::int32_t x = 0; x + 3 < rows; x += 3) {
      for (std::int32_t y = 0; y + 3 < rows; y += 3) pairs.push_back({0, x, 1, y});
    }
    std::size_t pixels = 0;
    for (const TracedPath& traced : trace_paths(library, pairs, constants)) {
      pixels += traced.path.pixels.size();
    }
    return pixels / static_cast<std::size_t>(rows);
  };
  EXPECT_GT(pixels_a_sample(300), 50u);
  EXPECT_LE(pixels_a_sample(3000), 201u);
}

TEST(ClipExtents, OfWhatRecursForLongAreParts) {
  const PostureMatrix take = made_up_take(1, 0, 150);
  const PostureLibrary library({take, take}, constants);
  const std::vector<NearPair> pairs{{0, 50, 1, 50}, {0, 53, 1, 53}};
  std::vector<ClipExtent> extents = find_clip_extents(library, pairs, constants);
  std::ranges::sort(extents, {}, [](const ClipExtent& e) { return std::pair(e.take, e.begin); });
  ASSERT_EQ(extents.size(), 6u);
  for (std::size_t i = 0; i < extents.size(); ++i) {
    EXPECT_LE(extents[i].end - extents[i].begin, constants.most_clip_s * constants.rate);
    EXPECT_EQ(extents[i].begin, i % 3 == 0 ? 0 : extents[i - 1].end);
  }
  EXPECT_EQ(extents[5].end, take.rows());
}

}  // namespace
}  // namespace reprise
