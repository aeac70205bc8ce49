// Keys in rows of many are a sorted set of pairs, whatever order they come and go in.
#include "store/key_rows.h"

#include <optional>
#include <set>

#include "store/sample_store.h"

namespace reprise {
namespace {

class KeyRowsTest : public StoreTest, public testing::WithParamInterface<KeyTarget> {
 protected:
  using Pair = std::pair<std::int64_t, std::int64_t>;

  KeyRowsTest() {
    make_sample(path_, 1);
    database_.emplace(path_, Database::Mode::write);
    database_->run("BEGIN; DELETE FROM keys");
  }

  void expect_all(const std::set<Pair>& pairs, std::mt19937& random) const {
    const KeyRows keys(*database_, GetParam());
    EXPECT_EQ(keys.count(), pairs.size());
    for (int i = 0; i < 50; ++i) {
      std::int64_t first = number(random, most_key), last = number(random, most_key);
      if (last < first) std::swap(first, last);
      if (i % 2 == 0) last = first;
      std::set<std::int64_t> expected;
      for (const auto& [key, take] : pairs) {
        if (key >= first && key <= last) expected.insert(take);
      }
      const std::vector<std::int64_t> found = keys.find(first, last);
      EXPECT_TRUE(std::ranges::equal(found, expected)) << first << " " << last;
    }
  }

  static std::int64_t number(std::mt19937& random, std::int64_t most) {
    return std::uniform_int_distribution<std::int64_t>(0, most)(random);
  }

  std::int64_t rows() const {
    Statement count(*database_, "SELECT count(*) FROM keys");
    return count.step() ? count.integer() : 0;
  }

  static constexpr std::int64_t most_key = (std::int64_t{1} << key_bits) - 1;
  static constexpr std::int64_t most_take = (std::int64_t{1} << key_target_bits) - 1;
  std::optional<Database> database_;
};

TEST_P(KeyRowsTest, ComeAndGoAsASetOfPairs) {
  std::mt19937 random(1);
  const KeyRows keys(*database_, GetParam());
  // Few keys lead to many takes, many to one, and the extremes are among both.
  for (const auto& [last_key, last_take] :
       {Pair{3, 5000}, Pair{most_key, 5000}, Pair{most_key, most_take}, Pair{0, most_take}}) {
    std::set<Pair> pairs = {{0, 0}, {last_key, last_take}};
    for (const auto& [key, take] : pairs) keys.add(key, take);
    for (int i = 0; i < 1500; ++i) {
      const Pair pair = {number(random, last_key), number(random, last_take)};
      keys.add(pair.first, pair.second);
      keys.add(pair.first, pair.second);
      pairs.insert(pair);
      if (i % 3 == 0) {
        const auto gone =
            std::next(pairs.begin(), number(random, static_cast<std::int64_t>(pairs.size()) - 1));
        keys.remove(gone->first, gone->second);
        keys.remove(gone->first, gone->second);
        pairs.erase(gone);
      }
    }
    expect_all(pairs, random);
    for (const auto& [key, take] : pairs) keys.remove(key, take);
    EXPECT_EQ(rows(), 0);
    EXPECT_EQ(keys.count(), 0u);
    EXPECT_TRUE(keys.find(0, most_key).empty());
  }
}

TEST_P(KeyRowsTest, ManyShareARow) {
  std::mt19937 random(2);
  const KeyRows keys(*database_, GetParam());
  for (int i = 0; i < 3000; ++i) keys.add(number(random, most_key), number(random, 9999));
  EXPECT_LT(rows(), 3000 / 32);
}

TEST_P(KeyRowsTest, LeaveOthersAlone) {
  const KeyRows keys(*database_, GetParam());
  const KeyRows others(*database_,
                       GetParam() == KeyTarget::take ? KeyTarget::block : KeyTarget::take);
  for (const auto& [key, id] : {Pair{0, 0}, Pair{7, 9}, Pair{most_key, most_take}}) {
    others.add(key, id);
    EXPECT_TRUE(keys.find(0, most_key).empty());
    keys.remove(key, id);
    EXPECT_EQ(keys.count(), 0u);
  }
  EXPECT_EQ(others.find(0, most_key).size(), 3u);
  keys.add(7, 10);
  EXPECT_EQ(others.find(7, 7), std::vector<std::int64_t>{9});
}

INSTANTIATE_TEST_SUITE_P(, KeyRowsTest, testing::Values(KeyTarget::take, KeyTarget::block),
                         [](const auto& target) {
                           return target.param == KeyTarget::take ? "Takes" : "Blocks";
                         });

}  // namespace
}  // namespace reprise
