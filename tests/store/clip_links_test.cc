// Clips that repeat clips of other takes, and what becomes of them when takes go.
#include <map>

#include "store/sample_store.h"

namespace reprise {
namespace {

class ClipLinks : public StoreTest {
 protected:
  /// Takes 0 to 5, each of one clip; those of 1, 2 and 3 repeat that of 0, and that of 5 that of 4.
  void SetUp() override {
    store_.emplace(ArchiveStore::open_for_writing(path_));
    store_->begin();
    ground_ = lay_ground(*store_);
    for (const int number : numbers) ids_[number] = add_unique(number);
    store_->commit();
    unlinked_ = store_->content_digest();
    store_->begin();
    std::map<std::int64_t, std::vector<ClipRecord>> changes;
    changes[ids_[0]] = {changed(0, ClipKind::primary, 0)};
    changes[ids_[12]] = {changed(12, ClipKind::primary, 0)};
    for (const int number : {2, 3, 5}) {
      changes[ids_[number]] = {changed(number, ClipKind::repeated, 0)};
    }
    changes[ids_[14]] = {changed(14, ClipKind::repeated, 12)};
    store_->set_clips(changes);
    store_->commit();
  }

  std::int64_t add_unique(int number) {
    return store_->add_take(sample_take(ground_, number), std::vector{sample_clip(number)});
  }

  ClipRecord changed(int number, ClipKind kind, int primary) {
    ClipRecord clip = sample_clip(number);
    clip.kind = kind;
    clip.group = 3;
    clip.primary_place = {ids_[primary], 0};
    return clip;
  }

  ClipRecord clip_of(int number) const {
    const std::int64_t ids[] = {ids_.at(number)};
    return store_->clips(ids).at(0);
  }

  void remove(std::initializer_list<int> takes) {
    store_->begin();
    for (const int number : takes) store_->remove_take(ids_[number]);
    store_->commit();
    EXPECT_TRUE(store_->check_structure().empty());
  }

  /// None of them is of two clips.
  static constexpr std::array<int, 6> numbers{0, 2, 3, 5, 12, 14};
  std::optional<ArchiveStore> store_;
  Ground ground_;
  std::map<int, std::int64_t> ids_;
  Digest unlinked_{};
};

TEST_F(ClipLinks, LeadToThePrimary) {
  EXPECT_TRUE(store_->check_structure().empty());
  EXPECT_EQ(clip_of(0).kind, ClipKind::primary);
  EXPECT_EQ(clip_of(3).kind, ClipKind::repeated);
  EXPECT_EQ(clip_of(3).primary, sample_clip(0).id);
  EXPECT_EQ(clip_of(14).primary, sample_clip(12).id);
  EXPECT_EQ(clip_of(14).group, 3);
  EXPECT_EQ(clip_of(0).primary, 0u);
  EXPECT_NE(store_->content_digest(), unlinked_);
  EXPECT_EQ(store_->takes({"", "", "", ClipKind::repeated}).size(), 4u);
}

TEST_F(ClipLinks, ARepeatOfWhatIsRemovedIsUnique) {
  remove({0});
  for (const int number : {2, 3, 5}) EXPECT_EQ(clip_of(number).kind, ClipKind::unique);
  EXPECT_EQ(clip_of(14).kind, ClipKind::repeated);
}

TEST_F(ClipLinks, APrimaryWithoutRepeatsIsUnique) {
  remove({2, 3});
  EXPECT_EQ(clip_of(0).kind, ClipKind::primary);
  remove({5, 14});
  EXPECT_EQ(clip_of(0).kind, ClipKind::unique);
  EXPECT_EQ(clip_of(12).kind, ClipKind::unique);
}

TEST_F(ClipLinks, AnyOrderOfRemovalsLeavesAWholeArchive) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<int> order(numbers.begin(), numbers.end());
    std::ranges::shuffle(order, random);
    store_->begin();
    for (std::size_t i = 0; i < order.size() / 2; ++i) store_->remove_take(ids_[order[i]]);
    store_->commit();
    EXPECT_TRUE(store_->check_structure().empty());
    store_.reset();
    std::filesystem::remove(path_);
    SetUp();
  }
}

TEST_F(ClipLinks, ARollbackTakesThemBack) {
  const Digest before = store_->content_digest();
  store_->begin();
  store_->remove_take(ids_[0]);
  store_->roll_back();
  EXPECT_EQ(store_->content_digest(), before);
  EXPECT_EQ(clip_of(3).kind, ClipKind::repeated);
  remove({12});
  EXPECT_EQ(clip_of(14).kind, ClipKind::unique);
}

TEST_F(ClipLinks, TheContentIsTheSameInAnyOrder) {
  const Digest before = store_->content_digest();
  ArchiveStore other = ArchiveStore::open_for_writing(folder_ / "other.rpz");
  other.begin();
  const Ground ground = lay_ground(other);
  std::map<int, std::int64_t> ids;
  for (const int number : {14, 5, 0, 12, 3, 2}) {
    ids[number] = other.add_take(sample_take(ground, number), std::vector{sample_clip(number)});
  }
  ids_ = ids;
  other.set_clips({{ids[0], {changed(0, ClipKind::primary, 0)}},
                   {ids[12], {changed(12, ClipKind::primary, 0)}},
                   {ids[2], {changed(2, ClipKind::repeated, 0)}},
                   {ids[3], {changed(3, ClipKind::repeated, 0)}},
                   {ids[5], {changed(5, ClipKind::repeated, 0)}},
                   {ids[14], {changed(14, ClipKind::repeated, 12)}}});
  other.commit();
  EXPECT_EQ(other.content_digest(), before);
}

}  // namespace
}  // namespace reprise
