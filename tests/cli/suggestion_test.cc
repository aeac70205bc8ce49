#include "cli/suggestion.h"

#include <gtest/gtest.h>

namespace reprise::cli {
namespace {

TEST(Suggestion, DistanceCountsEdits) {
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("jobs", "jobs"), 0U);
  EXPECT_EQ(edit_distance("jbos", "jobs"), 1U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("abc", "xyz"), edit_distance("xyz", "abc"));
}

TEST(Suggestion, NearestOrBegunWordIsMeant) {
  const std::vector<std::string> options{"--jobs", "--json", "--overwrite", "--prefix"};
  EXPECT_EQ(suggest("--jbos", options), "--jobs");
  EXPECT_EQ(suggest("--over", options), "--overwrite");
  EXPECT_EQ(suggest("--zzzzzz", options), std::nullopt);
  EXPECT_EQ(suggest(std::string(100000, 'a'), options), std::nullopt);
}

}  // namespace
}  // namespace reprise::cli
