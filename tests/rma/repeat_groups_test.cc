// Groups of clips that repeat one motion.
#include "rma/repeat_groups.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "query/near_windows.h"
#include "rma/clip_extents.h"
#include "rma/made_up_postures.h"
#include "rma/posture_reach.h"

namespace reprise {
namespace {

const RepeatConstants constants;

bool holds(const RepeatGroup& group, std::size_t take, long begin, long end) {
  return std::ranges::any_of(group.occurrences, [&](const Occurrence& o) {
    return o.take == take && overlap_ratio(o.begin, o.end, begin, end) >= 0.5;
  });
}

TEST(RepeatGroups, HoldEveryPlantedClipOnce) {
  const PostureLibrary library = planted_library(constants);
  const auto groups =
      find_repeat_groups(library, find_near_pairs(library, constants), std::nullopt, constants);
  EXPECT_TRUE(std::ranges::any_of(groups, [](const RepeatGroup& group) {
    return holds(group, 0, 45, 75) && holds(group, 1, 30, 90) && holds(group, 2, 60, 80);
  }));
}

TEST(RepeatGroups, MembersAreHeldAgainstTheReference) {
  const PostureLibrary library = planted_library(constants);
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
  const PostureLibrary library = planted_library(constants);
  const auto groups =
      find_repeat_groups(library, find_near_pairs(library, constants, 1), 1, constants);
  ASSERT_FALSE(groups.empty());
  EXPECT_TRUE(holds(groups[0], 0, 45, 75));
}

TEST(RepeatGroups, ReferencesAreNotInManyGroups) {
  // One motion over and over: every window is near to every other one.
  std::vector<PostureMatrix> takes;
  for (int take = 0; take < 4; ++take) {
    takes.push_back(joined({made_up_take(1, 0, 3), made_up_take(1, 0, 3), made_up_take(1, 0, 3)}));
  }
  const PostureLibrary library(std::move(takes), constants);
  const auto pairs = find_near_pairs(library, constants);
  std::vector<std::vector<int>> times(library.takes(), std::vector<int>(200, 0));
  for (const RepeatGroup& group : find_repeat_groups(library, pairs, std::nullopt, constants)) {
    const auto told = [&](const Occurrence& o, int least) {
      const auto at = times[o.take].begin();
      return std::count_if(at + o.begin, at + o.end, [&](int t) { return t >= least; });
    };
    // A group around the clip or around what is like it.
    EXPECT_TRUE(std::ranges::any_of(group.occurrences, [&](const Occurrence& o) {
      return static_cast<double>(told(o, constants.explained_times)) <
             constants.explained_cover * static_cast<double>(o.end - o.begin);
    }));
    for (const Occurrence& o : group.occurrences) {
      for (long s = o.begin; s < o.end; ++s) ++times[o.take][static_cast<std::size_t>(s)];
    }
  }
  EXPECT_TRUE(std::ranges::any_of(times[0], [](int t) { return t > 0; }));

  RepeatConstants unlimited;
  unlimited.explained_cover = 2;
  const auto all = find_repeat_groups(library, pairs, std::nullopt, unlimited);
  EXPECT_GT(all.size(), find_repeat_groups(library, pairs, std::nullopt, constants).size());
}

TEST(RepeatGroups, StancesAreNotMotion) {
  const PostureMatrix still = made_up_posture(1, 0).replicate(60, 1);
  const PostureLibrary library({still, still}, constants);
  EXPECT_TRUE(
      find_repeat_groups(library, find_near_pairs(library, constants), std::nullopt, constants)
          .empty());
}

/// A stand that sways by some 10 mm, never twice the same way; all of them are alike.
PostureMatrix swaying_stand(int seed, double seconds) {
  constexpr float sway = 0.08F;
  PostureMatrix stand = sway * made_up_take(seed, 0, seconds);
  stand.rowwise() += made_up_posture(100, 0);
  return stand;
}

/// One motion of 2 s between stands of 4 s and more, at 4 s, 5 s and 6 s; and stands alone.
PostureLibrary motion_between_stands() {
  const auto around_motion = [](int seed, double before) {
    return joined({swaying_stand(seed, before), made_up_take(1, 0, 2), swaying_stand(seed + 1, 5)});
  };
  return PostureLibrary({around_motion(10, 4), around_motion(12, 5), around_motion(14, 6),
                         swaying_stand(16, 12), swaying_stand(17, 12)},
                        constants);
}

TEST(RepeatGroups, StandsDoNotCarryAMotionOn) {
  PostureLibrary library = motion_between_stands();
  library.follow_reach(constants);
  const auto groups =
      find_repeat_groups(library, find_near_pairs(library, constants), std::nullopt, constants);
  EXPECT_TRUE(std::ranges::any_of(groups, [&](const RepeatGroup& group) {
    const auto& all = group.occurrences;
    return all.size() == 3 && std::ranges::all_of(all, [&](const Occurrence& o) {
             const long begin = 60 + 15 * static_cast<long>(o.take);
             return o.take < 3 && overlap_ratio(o.begin, o.end, begin, begin + 30) >= 0.75;
           });
  }));
}

TEST(RepeatsOfAClip, HaveToBeNearerWhereAllIsAlike) {
  PostureLibrary library = motion_between_stands();
  const Occurrence stand{3, 0, 30, 0}, motion{0, 60, 90, 0};
  const RepeatGroup alike = find_repeats_of(library, stand, constants);
  library.follow_reach(constants);
  const RepeatGroup nearer = find_repeats_of(library, stand, constants);
  EXPECT_LT(nearer.occurrences.size(), alike.occurrences.size());
  const float most = *std::ranges::max_element(library.similar_mm[3]);
  for (const Occurrence& o : nearer.occurrences) EXPECT_LT(o.distance_mm, most);
  EXPECT_EQ(find_repeats_of(library, motion, constants).occurrences.size(), 3u);
}

/// The same motion in another style: every posture about 70 mm off, one way for the whole clip.
PostureMatrix styled(const PostureMatrix& motion) {
  PostureMatrix other = motion;
  for (Eigen::Index c = 0; c < other.cols(); ++c) other.col(c).array() += c % 2 == 0 ? 40.F : -40.F;
  return other;
}

TEST(RepeatsOfAClip, MayBeFurtherApartWhereAnotherSubjectDoesIt) {
  PostureLibrary library(
      {joined({made_up_take(2, 0, 3), made_up_take(1, 0, 2)}),
       joined({made_up_take(3, 0, 3), styled(made_up_take(1, 0, 2))}), made_up_take(4, 0, 5)},
      constants);
  const Occurrence clip{0, 45, 75, 0};
  const auto repeats = [&] { return find_repeats_of(library, clip, constants).occurrences; };
  EXPECT_EQ(repeats().size(), 1u);
  library.subjects = {"a", "a", "a"};
  EXPECT_EQ(repeats().size(), 1u);
  library.subjects = {"a", "b", "a"};
  ASSERT_EQ(repeats().size(), 2u);
  EXPECT_EQ(repeats()[1].take, 1u);
  EXPECT_GT(repeats()[1].distance_mm, constants.member_mm);
  EXPECT_LE(repeats()[1].distance_mm, constants.across_subjects * constants.member_mm);
}

TEST(RepeatGroups, AreFoundAcrossSubjectsWhereItIsKnownWhoMoves) {
  PostureLibrary library({joined({made_up_take(2, 0, 3), made_up_take(1, 0, 2)}),
                          joined({made_up_take(3, 0, 3), styled(made_up_take(1, 0, 2))})},
                         constants);
  const auto groups = [&] {
    return find_repeat_groups(library, find_near_pairs(library, constants), std::nullopt,
                              constants);
  };
  EXPECT_TRUE(groups().empty());
  library.subjects = {"a", "b"};
  ASSERT_EQ(groups().size(), 1u);
  EXPECT_TRUE(holds(groups()[0], 0, 45, 75) && holds(groups()[0], 1, 45, 75));
}

TEST(PostureReach, IsShortWhereManyPosturesAreNear) {
  const PostureLibrary library = motion_between_stands();
  const auto reaches = posture_reaches(library.projected, constants.reach_part);
  ASSERT_EQ(reaches.size(), library.takes());
  for (std::size_t take = 0; take < library.takes(); ++take) {
    ASSERT_EQ(static_cast<long>(reaches[take].size()), library.projected[take].rows());
  }
  for (std::size_t s = 0; s < 60; ++s) EXPECT_LT(reaches[0][s], 60);
  for (std::size_t s = 65; s < 85; ++s) EXPECT_GT(reaches[0][s], 100);
}

TEST(PostureReach, IsAMatterOfThePart) {
  const PostureLibrary library = motion_between_stands();
  const auto none = posture_reaches(library.projected, 0);
  const auto all = posture_reaches(library.projected, 1);
  const auto some = posture_reaches(library.projected, 0.1);
  for (std::size_t s = 0; s < some[0].size(); ++s) {
    EXPECT_NEAR(none[0][s], 0, 1);  // a posture is near itself
    EXPECT_LE(none[0][s], some[0][s]);
    EXPECT_LT(some[0][s], all[0][s]);
  }
}

TEST(PostureReach, OfTakesWithoutSamples) {
  EXPECT_TRUE(posture_reaches({}, 0.1).empty());
  const std::vector<PostureMatrix> takes{PostureMatrix(0, 3)};
  const auto reaches = posture_reaches(takes, 0.1);
  ASSERT_EQ(reaches.size(), 1u);
  EXPECT_TRUE(reaches[0].empty());
}

TEST(PostureLibrary, WhatIsSimilarFollowsTheReach) {
  PostureLibrary library = motion_between_stands();
  // Motion that is far from all else, and from itself.
  std::vector<PostureMatrix> takes = library.postures;
  for (const int seed : {20, 21}) takes.push_back(4 * made_up_take(seed, 0, 4));
  library = PostureLibrary(std::move(takes), constants);
  library.follow_reach(constants);
  const auto reaches = posture_reaches(library.projected, constants.reach_part);
  std::size_t near = 0, far = 0;
  for (std::size_t take = 0; take < library.takes(); ++take) {
    for (std::size_t s = 0; s < reaches[take].size(); ++s) {
      const float reach = reaches[take][s], similar = library.similar_mm[take][s];
      const float across = library.similar_across_mm[take][s];
      EXPECT_GE(across, similar);
      EXPECT_LE(across, 1.001F * constants.across_subjects * similar);
      const float in_proportion = constants.similar_mm * reach / constants.reach_mm;
      if (reach < constants.reach_mm) {
        EXPECT_NEAR(similar, std::max(1.0F, in_proportion), 0.01F);
        ++near;
      } else {  // more than at reach_mm, but less than in proportion
        EXPECT_GE(similar, 0.999F * constants.similar_mm);
        EXPECT_LE(similar, 1.001F * in_proportion);
        far += similar > 1.5F * constants.similar_mm ? 1 : 0;
      }
    }
  }
  EXPECT_GT(near, 100u);
  EXPECT_GT(far, 20u);
}

TEST(RepeatGroups, LargeMotionMayBeDoneAgainLessExactly) {
  // 80 mm apart on average, but everything else is much further.
  const auto large = [](int seed) { return PostureMatrix(4 * made_up_take(seed, 0, 4)); };
  PostureMatrix again = large(1);
  for (Eigen::Index c = 0; c < again.cols(); c += 3) again.col(c).array() += 80;
  PostureLibrary library({large(1), again, large(2), large(3), large(4)}, constants);
  const auto found = [&] {
    return find_repeat_groups(library, find_near_pairs(library, constants), std::nullopt,
                              constants);
  };
  EXPECT_TRUE(found().empty());
  library.follow_reach(constants);
  ASSERT_FALSE(found().empty());
  for (const RepeatGroup& group : found()) {
    for (const Occurrence& o : group.occurrences) EXPECT_LT(o.take, 2u);
  }
}

/// Every joint of a posture this much further (mm): as far as that from the posture on average.
PostureMatrix moved(PostureMatrix motion, float mm) {
  for (Eigen::Index c = 0; c < motion.cols(); c += 3) motion.col(c).array() += mm;
  return motion;
}

TEST(RepeatGroups, ShortClipsHaveToBeNearer) {
  const float apart = 0.5F * (1 + constants.short_share) * constants.member_mm;
  const PostureLibrary library(
      {made_up_take(1, 0, 4), moved(made_up_take(1, 0, 4), apart), made_up_take(2, 0, 4)},
      constants);
  const auto pairs = find_near_pairs(library, constants);
  const auto groups_of = [&](long samples) {
    const std::vector<Occurrence> clip{{0, 10, 10 + samples, 0}};
    return find_groups_of(library, pairs, clip, constants).size();
  };
  EXPECT_EQ(groups_of(std::lround(constants.whole_clip_s * constants.rate)), 1u);
  EXPECT_EQ(groups_of(std::lround(constants.least_path_s * constants.rate)), 0u);
}

TEST(RepeatsOfAClip, MayBeAsFarAsMembersWhereAllIsAlike) {
  PostureLibrary library({made_up_take(1, 0, 4), moved(made_up_take(1, 0, 4), 40)}, constants);
  const Occurrence clip{0, 10, 50, 0};
  const auto found = [&](float similar_mm) {
    for (auto& take : library.similar_mm) std::ranges::fill(take, similar_mm);
    return find_repeats_of(library, clip, constants).occurrences.size() == 2;
  };
  const float just = 40 * constants.similar_mm / (constants.asked_share * constants.member_mm);
  EXPECT_TRUE(found(1.05F * just));
  EXPECT_FALSE(found(0.95F * just));
}

TEST(RepeatGroups, OfNothing) {
  EXPECT_TRUE(
      find_repeat_groups(PostureLibrary({}, constants), {}, std::nullopt, constants).empty());
}

TEST(RepeatsOfAClip, AreFoundAtOtherSpeeds) {
  const PostureLibrary library = planted_library(constants);
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
