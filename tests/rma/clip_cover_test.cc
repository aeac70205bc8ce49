// What chosen clips leave of takes, and who gets it.
#include "rma/clip_cover.h"

#include <gtest/gtest.h>

namespace reprise {
namespace {

using enum ClipRole;

constexpr long least = 5;

/// A repeated clip beside samples of a primary that starts at 100.
ChosenClip repeated_clip(std::size_t take, long begin, long end, std::size_t primary) {
  ChosenClip clip{take, begin, end, repeated, primary, {}};
  for (long s = begin; s < end; ++s) clip.reference.push_back(100 + s - begin);
  return clip;
}

void expect_clip(const ChosenClip& clip, std::size_t take, long begin, long end, ClipRole role) {
  EXPECT_EQ(clip.take, take);
  EXPECT_EQ(clip.begin, begin);
  EXPECT_EQ(clip.end, end);
  EXPECT_EQ(clip.role, role);
}

TEST(ClipCover, WhatIsLeftBecomesUnique) {
  const auto clips = cover_takes({repeated_clip(1, 10, 20, 1), {0, 100, 110, primary, 0, {}}},
                                 std::vector<long>{110, 40}, least);
  ASSERT_EQ(clips.size(), 5u);
  expect_clip(clips[0], 0, 0, 100, unique);
  expect_clip(clips[1], 0, 100, 110, primary);
  expect_clip(clips[2], 1, 0, 10, unique);
  expect_clip(clips[3], 1, 10, 20, repeated);
  expect_clip(clips[4], 1, 20, 40, unique);
  EXPECT_EQ(clips[3].primary, 1u) << "its place among all clips";
}

TEST(ClipCover, ShortRestsGoToRepeatedClips) {
  const auto clips = cover_takes(
      {{0, 100, 110, primary, 0, {}}, repeated_clip(1, 2, 12, 0), repeated_clip(1, 16, 26, 0)},
      std::vector<long>{110, 28}, least);
  ASSERT_EQ(clips.size(), 4u);
  expect_clip(clips[2], 1, 0, 16, repeated);
  expect_clip(clips[3], 1, 16, 28, repeated);
  // What was added stays at the primary's first or last sample beside it.
  const std::vector<long> first = {100, 100, 100, 101, 102, 103, 104, 105,
                                   106, 107, 108, 109, 109, 109, 109, 109};
  EXPECT_EQ(clips[2].reference, first);
  EXPECT_EQ(clips[3].reference.size(), 12u);
  EXPECT_EQ(clips[3].reference.back(), 109);
}

TEST(ClipCover, PrimariesDoNotGrow) {
  const auto clips = cover_takes({{0, 2, 12, primary, 0, {}}}, std::vector<long>{13}, least);
  ASSERT_EQ(clips.size(), 3u);
  expect_clip(clips[0], 0, 0, 2, unique);
  expect_clip(clips[1], 0, 2, 12, primary);
  expect_clip(clips[2], 0, 12, 13, unique);
}

TEST(ClipCover, TakesWithoutClipsAreUnique) {
  const auto clips = cover_takes({}, std::vector<long>{7, 0, 3}, least);
  ASSERT_EQ(clips.size(), 2u);
  expect_clip(clips[0], 0, 0, 7, unique);
  expect_clip(clips[1], 2, 0, 3, unique);
}

}  // namespace
}  // namespace reprise
