// Primary, repeated and unique clips.
#include "rma/clip_choice.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "query/near_windows.h"
#include "rma/clip_extents.h"
#include "rma/made_up_postures.h"

namespace reprise {
namespace {

const RepeatConstants constants;

std::vector<ChosenClip> clips_of(const PostureLibrary& library) {
  const auto groups =
      find_repeat_groups(library, find_near_pairs(library, constants), std::nullopt, constants);
  return choose_clips(library, groups, constants);
}

TEST(ClipChoice, CoversEveryTakeOnce) {
  const PostureLibrary library = planted_library(constants);
  std::vector<long> at(library.takes(), 0);
  for (const ChosenClip& clip : clips_of(library)) {
    EXPECT_EQ(clip.begin, at[clip.take]);
    EXPECT_GT(clip.end, clip.begin);
    at[clip.take] = clip.end;
  }
  for (std::size_t take = 0; take < library.takes(); ++take) {
    EXPECT_EQ(at[take], library.postures[take].rows());
  }
}

TEST(ClipChoice, FindsThePlantedClip) {
  const std::vector<ChosenClip> clips = clips_of(planted_library(constants));
  const auto clip_at = [&](std::size_t take, long begin, long end) {
    const auto found = std::ranges::find_if(clips, [&](const ChosenClip& c) {
      return c.take == take && c.role != ClipRole::unique &&
             overlap_ratio(c.begin, c.end, begin, end) >= 0.5;
    });
    return static_cast<std::size_t>(found - clips.begin());
  };
  const std::vector<std::size_t> planted = {clip_at(0, 45, 75), clip_at(1, 30, 90),
                                            clip_at(2, 60, 80)};
  std::size_t primaries = 0;
  for (const std::size_t c : planted) {
    ASSERT_LT(c, clips.size());
    primaries += clips[c].role == ClipRole::primary ? 1 : 0;
    if (clips[c].role == ClipRole::repeated) {
      EXPECT_TRUE(std::ranges::count(planted, clips[c].primary) == 1);
    }
  }
  EXPECT_EQ(primaries, 1u);
}

TEST(ClipChoice, RepeatedClipsKnowWhichSampleIsBesideEach) {
  const std::vector<ChosenClip> clips = clips_of(planted_library(constants));
  std::size_t repeated = 0;
  for (const ChosenClip& clip : clips) {
    if (clip.role != ClipRole::repeated) continue;
    ++repeated;
    const ChosenClip& primary = clips[clip.primary];
    EXPECT_EQ(primary.role, ClipRole::primary);
    ASSERT_EQ(clip.reference.size(), static_cast<std::size_t>(clip.end - clip.begin));
    EXPECT_TRUE(std::ranges::is_sorted(clip.reference));
    EXPECT_GE(clip.reference.front(), primary.begin);
    EXPECT_LT(clip.reference.back(), primary.end);
  }
  EXPECT_GE(repeated, 2u);
}

TEST(ClipChoice, RepeatsAtTheSameSpeedAreBesideTheSamplesThatTheyRepeat) {
  // Performance 1 at 45 in take 0, at 30 in take 1.
  const PostureLibrary library(
      {joined({made_up_take(2, 0, 3), made_up_take(1, 0, 3), made_up_take(3, 0, 3)}),
       joined({made_up_take(4, 0, 2), made_up_take(1, 0, 3), made_up_take(5, 0, 2)})},
      constants);
  std::size_t repeated = 0;
  for (const ChosenClip& clip : clips_of(library)) {
    if (clip.role != ClipRole::repeated) continue;
    ++repeated;
    const long planted = clip.take == 0 ? 45 : 30, other = clip.take == 0 ? 30 : 45;
    for (long s = std::max(clip.begin, planted); s < std::min(clip.end, planted + 45); ++s) {
      EXPECT_EQ(clip.reference[static_cast<std::size_t>(s - clip.begin)] - other, s - planted);
    }
  }
  EXPECT_EQ(repeated, 1u);
}

TEST(ClipChoice, SaysWhatTheGroupsSay) {
  const PostureLibrary library = planted_library(constants);
  const auto groups =
      find_repeat_groups(library, find_near_pairs(library, constants), std::nullopt, constants);
  std::vector<std::vector<bool>> recurs;
  for (const PostureMatrix& take : library.postures)
    recurs.emplace_back(static_cast<std::size_t>(take.rows()), false);
  for (const RepeatGroup& group : groups) {
    for (const Occurrence& o : group.occurrences)
      std::fill(recurs[o.take].begin() + o.begin, recurs[o.take].begin() + o.end, true);
  }
  const ClipChoiceConstants choice;
  const long least = std::lround(choice.least_s * constants.rate);
  long differ = 0, shared = 0;
  for (const ChosenClip& clip : choose_clips(library, groups, constants)) {
    const auto told = recurs[clip.take].begin();
    const auto repeated = static_cast<long>(std::count(told + clip.begin, told + clip.end, true));
    const bool unique = clip.role == ClipRole::unique;
    differ += unique ? repeated : clip.end - clip.begin - repeated;
    shared += unique ? 0 : repeated;
  }
  EXPECT_GT(shared, 80);
  EXPECT_LE(differ, 2 * least);
}

TEST(ClipChoice, EveryPrimaryHasARepeat) {
  const std::vector<ChosenClip> clips = clips_of(planted_library(constants));
  std::vector<bool> repeated(clips.size(), false);
  for (const ChosenClip& clip : clips) {
    if (clip.role == ClipRole::repeated) repeated[clip.primary] = true;
  }
  for (std::size_t c = 0; c < clips.size(); ++c) {
    EXPECT_EQ(repeated[c], clips[c].role == ClipRole::primary);
  }
}

TEST(ClipChoice, WithoutRepeatsTakesAreUnique) {
  const PostureLibrary library({made_up_take(1, 0, 4), PostureMatrix(0, 12)}, constants);
  const std::vector<ChosenClip> clips = choose_clips(library, {}, constants);
  ASSERT_EQ(clips.size(), 1u);
  EXPECT_EQ(clips[0].role, ClipRole::unique);
  EXPECT_EQ(clips[0].end, 60);
}

TEST(ClipChoice, StandingClipsStayAndAreRepeated) {
  const PostureLibrary library = planted_library(constants);
  const auto pairs = find_near_pairs(library, constants);
  // Take 0 is stored: its planted clip by itself, and another one that nothing repeats.
  const long rows = library.postures[0].rows();
  const std::vector<ChosenClip> standing = {{0, 0, 45, ClipRole::unique, 0, {}},
                                            {0, 45, 75, ClipRole::unique, 1, {}},
                                            {0, 75, rows, ClipRole::unique, 2, {}}};
  std::vector<Occurrence> references;
  for (const ChosenClip& clip : standing)
    references.push_back({clip.take, clip.begin, clip.end, 0});
  const auto groups = find_groups_of(library, pairs, references, constants);
  const auto clips = choose_clips(library, groups, constants, {}, standing);
  for (std::size_t c = 0; c < standing.size(); ++c) {
    EXPECT_EQ(clips[c].take, 0u);
    EXPECT_EQ(clips[c].begin, standing[c].begin);
    EXPECT_EQ(clips[c].end, standing[c].end);
  }
  EXPECT_EQ(clips[1].role, ClipRole::primary);
  std::size_t repeats = 0;
  for (const ChosenClip& clip : clips) {
    if (clip.role != ClipRole::repeated) continue;
    EXPECT_EQ(clip.primary, 1u);
    EXPECT_GT(clip.take, 0u);
    ++repeats;
  }
  EXPECT_EQ(repeats, 2u);
}

}  // namespace
}  // namespace reprise
