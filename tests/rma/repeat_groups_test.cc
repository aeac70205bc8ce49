// Groups of clips that repeat one motion.
#include "rma/repeat_groups.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "query/near_windows.h"
#include "rma/clip_extents.h"
#include "rma/made_up_postures.h"

namespace reprise {
namespace {

const RepeatConstants constants;

/// A clip of 2 s at 3 s in take 0, at 2 s and half speed in take 1, at 4 s and 1.5 times in take 2.
PostureLibrary planted_library() {
  return PostureLibrary(
      {joined({made_up_take(2, 0, 3), made_up_take(1, 0, 2), made_up_take(3, 0, 3)}),
       joined({made_up_take(4, 0, 2), made_up_take(1, 0, 4, 0.5), made_up_take(5, 0, 2)}),
       joined({made_up_take(6, 0, 4), made_up_take(1, 0, 4.0 / 3, 1.5), made_up_take(7, 0, 2)}),
       made_up_take(8, 0, 8)},
      constants);
}

bool holds(const RepeatGroup& group, std::size_t take, long begin, long end) {
  return std::ranges::any_of(group.occurrences, [&](const Occurrence& o) {
    return o.take == take && overlap_ratio(o.begin, o.end, begin, end) >= 0.5;
  });
}

TEST(RepeatGroups, HoldEveryPlantedClipOnce) {
  const PostureLibrary library = planted_library();
  const auto groups =
      find_repeat_groups(library, find_near_pairs(library, constants), std::nullopt, constants);
  EXPECT_TRUE(std::ranges::any_of(groups, [](const RepeatGroup& group) {
    return holds(group, 0, 45, 75) && holds(group, 1, 30, 90) && holds(group, 2, 60, 80);
  }));
}

TEST(RepeatGroups, MembersAreHeldAgainstTheReference) {
  const PostureLibrary library = planted_library();
  for (const RepeatGroup& group :
       find_repeat_groups(library, find_near_pairs(library, constants), std::nullopt, constants)) {
    ASSERT_GE(group.occurrences.size(), 2u);
    EXPECT_EQ(group.occurrences[0].distance_mm, 0);
    for (const Occurrence& o : group.occurrences) EXPECT_LE(o.distance_mm, constants.member_mm);
    for (std::size_t i = 0; i < group.occurrences.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const Occurrence &a = group.occurrences[i], &b = group.occurrences[k];
        EXPECT_TRUE(a.take != b.take || a.end <= b.begin || b.end <= a.begin);
      }
    }
  }
}

TEST(RepeatGroups, OfOneTakeHaveTheirReferenceInIt) {
  const PostureLibrary library = planted_library();
  const auto groups =
      find_repeat_groups(library, find_near_pairs(library, constants, 1), 1, constants);
  ASSERT_FALSE(groups.empty());
  EXPECT_TRUE(holds(groups[0], 0, 45, 75));
}

TEST(RepeatGroups, StancesAreNotMotion) {
  const PostureMatrix still = made_up_posture(1, 0).replicate(60, 1);
  const PostureLibrary library({still, still}, constants);
  EXPECT_TRUE(
      find_repeat_groups(library, find_near_pairs(library, constants), std::nullopt, constants)
          .empty());
}

TEST(RepeatGroups, OfNothing) {
  EXPECT_TRUE(
      find_repeat_groups(PostureLibrary({}, constants), {}, std::nullopt, constants).empty());
}

TEST(RepeatsOfAClip, AreFoundAtOtherSpeeds) {
  const PostureLibrary library = planted_library();
  const RepeatGroup group = find_repeats_of(library, {0, 45, 75, 0}, constants);
  EXPECT_EQ(group.occurrences.size(), 3u);
  EXPECT_TRUE(holds(group, 1, 30, 90));
  EXPECT_TRUE(holds(group, 2, 60, 80));
}

TEST(NearPairs, AreOfWindowsThatDoNotOverlap) {
  const PostureLibrary library({made_up_take(1, 0, 6), made_up_take(1, 0, 6)}, constants);
  const auto pairs = find_near_pairs(library, constants);
  ASSERT_FALSE(pairs.empty());
  for (const NearPair& pair : pairs) {
    EXPECT_TRUE(pair.take != pair.other_take || std::abs(pair.sample - pair.other_sample) > 6);
  }
}

}  // namespace
}  // namespace reprise
