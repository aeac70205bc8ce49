// What recurs and is in no clip goes to one.
#include "rma/clip_completion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace reprise {
namespace {

using enum ClipRole;

constexpr long least = 5;
const std::vector<long> samples = {60, 60, 60};

/// A member whose samples are one after another beside those of its reference.
Occurrence member(std::size_t take, long begin, long end) {
  Occurrence occurrence{take, begin, end, 10, {}};
  for (long s = begin; s < end; ++s) occurrence.map.push_back(s);
  return occurrence;
}

std::vector<ChosenClip> completed(std::vector<ChosenClip> clips,
                                  const std::vector<RepeatGroup>& groups,
                                  std::size_t standing = 0) {
  complete_clips(clips, groups, samples, least, standing);
  return clips;
}

void expect_clip(const ChosenClip& clip, std::size_t take, long begin, long end, ClipRole role) {
  EXPECT_EQ(clip.take, take);
  EXPECT_EQ(clip.begin, begin);
  EXPECT_EQ(clip.end, end);
  EXPECT_EQ(clip.role, role);
  if (role != repeated) return;
  EXPECT_EQ(clip.reference.size(), static_cast<std::size_t>(end - begin));
  EXPECT_TRUE(std::ranges::is_sorted(clip.reference));
}

TEST(ClipCompletion, AStretchRepeatsThePrimaryBesideIt) {
  const auto clips =
      completed({{0, 10, 30, primary, 0, {}}}, {{{{0, 10, 30, 0, {}}, member(1, 10, 30)}}});
  ASSERT_EQ(clips.size(), 2u);
  expect_clip(clips[1], 1, 10, 30, repeated);
  EXPECT_EQ(clips[1].primary, 0u);
  EXPECT_EQ(clips[1].reference.front(), 10);
  EXPECT_EQ(clips[1].reference.back(), 29);
}

TEST(ClipCompletion, WhatIsBesideARepeatRepeatsItsPrimary) {
  ChosenClip repeat{1, 20, 40, repeated, 0, {}};
  for (long s = 20; s < 40; ++s) repeat.reference.push_back(s);
  const auto clips =
      completed({{0, 20, 40, primary, 0, {}}, repeat}, {{{{1, 20, 40, 0, {}}, member(2, 20, 40)}}});
  ASSERT_EQ(clips.size(), 3u);
  expect_clip(clips[2], 2, 20, 40, repeated);
  EXPECT_EQ(clips[2].primary, 0u);
  EXPECT_EQ(clips[2].reference, repeat.reference);
}

TEST(ClipCompletion, WhereNoClipIsOneBecomesPrimary) {
  const auto clips = completed({}, {{{{1, 5, 25, 0, {}}, member(0, 5, 25)}}});
  ASSERT_EQ(clips.size(), 2u);
  expect_clip(clips[0], 1, 5, 25, primary);
  expect_clip(clips[1], 0, 5, 25, repeated);
  EXPECT_EQ(clips[1].primary, 0u);
}

TEST(ClipCompletion, ShortRestsGoToTheClipBesideThem) {
  const auto clips =
      completed({{0, 10, 30, primary, 0, {}}}, {{{{0, 8, 33, 0, {}}, member(1, 8, 33)}}});
  ASSERT_EQ(clips.size(), 2u);
  expect_clip(clips[0], 0, 8, 33, primary);
  expect_clip(clips[1], 1, 8, 33, repeated);
}

TEST(ClipCompletion, StandingClipsKeepTheirSamples) {
  const auto clips = completed(
      {{0, 0, 10, unique, 0, {}}, {0, 10, 30, unique, 1, {}}, {0, 30, 60, repeated, 2, {}}},
      {{{{0, 10, 30, 0, {}}, member(1, 10, 30)}}, {{{0, 32, 50, 0, {}}, member(2, 32, 50)}}}, 3);
  ASSERT_EQ(clips.size(), 4u);
  expect_clip(clips[0], 0, 0, 10, unique);
  expect_clip(clips[1], 0, 10, 30, primary);
  expect_clip(clips[3], 1, 10, 30, repeated);
  EXPECT_EQ(clips[3].primary, 1u);
  EXPECT_EQ(clips[2].role, repeated) << "its primary is not known, so that nothing repeats it";
}

}  // namespace
}  // namespace reprise
