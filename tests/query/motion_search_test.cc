#include "reprise/query/motion_search.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <thread>

#include "kept_folder.h"
#include "reprise/error.h"
#include "reprise/formats/motion_file.h"
#include "reprise/synth/library.h"

namespace reprise {

bool operator==(const SearchResult& a, const SearchResult& b) {
  return a.take == b.take && a.start == b.start && a.end == b.end &&
         a.distance_mm == b.distance_mm && a.unlikeness == b.unlikeness;
}

namespace {

namespace fs = std::filesystem;

SearchSetup with_jobs(unsigned jobs) {
  SearchSetup setup;
  setup.jobs = jobs;
  return setup;
}

SearchSetup keeping_cache() {
  SearchSetup setup;
  setup.write_cache = true;
  return setup;
}

class MotionSearchTest : public testing::Test {
 protected:
  MotionSearchTest()
      : folder_(fs::temp_directory_path() /
                ("motion_search_" + std::to_string(getpid()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~MotionSearchTest() override { fs::remove_all(folder_); }

  fs::path archive() const { return folder_ / "lib.rpz"; }
  fs::path cache() const { return search_cache_path(archive()); }

  void make_takes(std::size_t takes, double seconds) {
    options_.takes = takes;
    options_.seconds = seconds;
    options_.format = MotionFormat::bvh;
    library_ = make_synthetic_library(options_);
  }
  void write_takes() const { write_synthetic_library(folder_ / "takes", options_, true); }
  void store(std::vector<fs::path> paths, const std::string& prefix = "") const {
    IngestOptions ingest_options;
    ingest_options.paths = std::move(paths);
    ingest_options.fidelity.tier = FidelityTier::preview;
    ingest_options.fidelity.limit_mm = 20;
    ingest_options.prefix = prefix;
    ingest_options.jobs = 2;
    const IngestReport report = ingest(archive(), ingest_options);
    ASSERT_TRUE(report.rejected.empty());
  }
  /// Kept for the tests that ask for as many takes.
  void make_library(std::size_t takes = 10) {
    const fs::path libraries = REPRISE_TEST_LIBRARIES;
    const std::string key =
        program_key(fs::read_symlink("/proc/self/exe")) + "-" + std::to_string(takes);
    make_takes(takes, 8);
    fill_or_copy(libraries / key, folder_, [&] {
      write_takes();
      store({folder_ / "takes"});
      return !HasFailure();
    });
  }

  fs::path folder_;
  SynthOptions options_;
  SynthLibrary library_;
};

TEST_F(MotionSearchTest, ATakeOfTheLibraryIsFoundFirstByItsFile) {
  make_library();
  MotionSearch search(archive());
  for (const Take& take : library_.takes) {
    const auto results = search.like(take);
    ASSERT_EQ(results.size(), 10u);
    EXPECT_EQ(results[0].take, take.name);
    EXPECT_NEAR(results[0].start, 0, 1e-9);
    EXPECT_NEAR(results[0].end, take.seconds(), 0.15);
    EXPECT_LT(results[0].distance_mm, 40);
    EXPECT_TRUE(results[0].repeat);
  }
}

TEST_F(MotionSearchTest, RepeatsComeFirstByDistanceAndThenTheRestByUnlikeness) {
  make_library();
  const Archive opened(archive());
  MotionSearch search(archive());
  std::size_t repeats = 0, rest = 0;
  for (const TakeInfo& take : opened.takes()) {
    SearchOptions options;
    options.from = 0;
    options.to = 2;
    options.all_occurrences = true;
    for (const auto& results : {search.like(take), search.like(take, options)}) {
      const auto first_other = std::ranges::find(results, false, &SearchResult::repeat);
      EXPECT_TRUE(std::is_sorted(results.begin(), first_other, [](const auto& a, const auto& b) {
        return a.distance_mm < b.distance_mm;
      }));
      EXPECT_TRUE(std::none_of(first_other, results.end(), [](const auto& r) { return r.repeat; }));
      EXPECT_TRUE(std::is_sorted(first_other, results.end(), [](const auto& a, const auto& b) {
        return a.unlikeness < b.unlikeness;
      }));
      repeats += static_cast<std::size_t>(first_other - results.begin());
      rest += static_cast<std::size_t>(results.end() - first_other);
    }
  }
  EXPECT_GT(repeats, 0u);
  EXPECT_GT(rest, 0u);
}

TEST_F(MotionSearchTest, WhatHardlyMovesIsNoRepeatOfWhatDoes) {
  make_library();
  MotionSearch search(archive());
  // A take that stands still, as its first frame, and hardly shakes.
  Take still = library_.takes[0];
  for (long frame = 0; frame < still.frames(); ++frame)
    still.channels.row(frame) = library_.takes[0].channels.row(0);
  for (const SearchResult& result : search.like(still)) EXPECT_FALSE(result.repeat);
}

TEST_F(MotionSearchTest, ATakeOfTheArchiveDoesNotFindItself) {
  make_library();
  const Archive opened(archive());
  MotionSearch search(archive());
  for (const TakeInfo& take : opened.takes()) {
    SearchOptions options;
    const auto all = search.like(take, options);
    EXPECT_EQ(all.size(), 9u);
    EXPECT_EQ(std::ranges::count(all, take.name, &SearchResult::take), 0);
    options.across_subjects = true;
    for (const SearchResult& result : search.like(take, options)) {
      EXPECT_NE(result.subject, take.subject);
    }
    options = {};
    options.limit_mm = all[4].distance_mm;
    for (const SearchResult& result : search.like(take, options)) {
      EXPECT_LE(result.distance_mm, *options.limit_mm);
    }
    options.top = 2;
    EXPECT_LE(search.like(take, options).size(), 2u);
  }
}

TEST_F(MotionSearchTest, PlantedRepeatsAreFoundWhereTheyAre) {
  make_library(16);
  const Archive opened(archive());
  MotionSearch search(archive());
  std::size_t asked = 0, found = 0;
  for (const auto& group : library_.truth) {
    for (const SynthOccurrence& other : group) {
      if (&other == &group[0] || other.file == group[0].file) continue;
      SearchOptions options;
      options.from = group[0].start_s;
      options.to = group[0].end_s;
      options.top = 5;
      ++asked;
      for (const SearchResult& result : search.like(opened.find_take(group[0].file), options)) {
        const double shared =
            std::min(result.end, other.end_s) - std::max(result.start, other.start_s);
        if (result.take == other.file && shared > 0.5 * (other.end_s - other.start_s)) {
          ++found;
          break;
        }
      }
    }
  }
  ASSERT_GT(asked, 5u);
  EXPECT_GE(found * 10, asked * 7) << found << " of " << asked;
}

TEST_F(MotionSearchTest, AMotionThatGoesOnIsFoundAsOftenAsItFits) {
  make_takes(6, 8);
  write_takes();
  const long half = std::lround(2 * library_.takes[0].frame_rate);
  const ChannelMatrix forth = library_.takes[0].channels.topRows(half);
  const ChannelMatrix back = forth.colwise().reverse();
  Take take = library_.takes[0];
  take.name = "again";
  take.channels.resize(12 * half, forth.cols());
  for (long i = 0; i < 12; ++i) take.channels.middleRows(i * half, half) = i % 2 ? back : forth;
  std::ofstream(folder_ / "takes" / "again.bvh") << write_bvh(take);
  store({folder_ / "takes"});

  MotionSearch search(archive());
  SearchOptions options;
  options.from = 0;
  options.to = 4;
  options.all_occurrences = true;
  std::size_t found = 0;
  for (const SearchResult& result : search.like(Archive(archive()).find_take("again"), options)) {
    found += result.take == "again";
  }
  // Five times are left after the example; others start within one time and end in the next.
  EXPECT_GT(found, 5u);
}

TEST_F(MotionSearchTest, BodiesOfOtherSkeletonsAreCompared) {
  make_library(6);
  SynthOptions other = options_;
  other.format = MotionFormat::asf_amc;
  MotionSearch search(archive());
  std::size_t first = 0;
  for (const Take& take : make_synthetic_library(other).takes) {
    const auto results = search.like(take);
    ASSERT_FALSE(results.empty());
    first += results[0].take == take.name;
  }
  EXPECT_GE(first, 5u);
}

TEST_F(MotionSearchTest, ACacheAndThreadsChangeNoResult) {
  make_library();
  const TakeInfo take = Archive(archive()).takes()[3];
  SearchOptions part;
  part.from = 2;
  part.to = 4;
  part.all_occurrences = true;
  const auto expected = MotionSearch(archive(), with_jobs(1)).like(take, part);
  ASSERT_FALSE(expected.empty());
  EXPECT_FALSE(fs::exists(cache()));
  EXPECT_EQ(MotionSearch(archive(), with_jobs(3)).like(take, part), expected);
  EXPECT_EQ(MotionSearch(archive(), keeping_cache()).like(take, part), expected);
  ASSERT_TRUE(fs::exists(cache()));
  EXPECT_EQ(MotionSearch(archive()).like(take, part), expected);
}

TEST_F(MotionSearchTest, ADamagedCacheIsMadeAgain) {
  make_library(6);
  const TakeInfo take = Archive(archive()).takes()[0];
  MotionSearch(archive(), keeping_cache());
  const auto expected = MotionSearch(archive()).like(take);
  const auto size = fs::file_size(cache());
  for (const std::uintmax_t at : {std::uintmax_t{3}, std::uintmax_t{30}, size / 2, size - 3}) {
    {
      std::fstream file(cache(), std::ios::in | std::ios::out | std::ios::binary);
      file.seekp(static_cast<std::streamoff>(at));
      file.put('\x5a');
    }
    EXPECT_EQ(MotionSearch(archive()).like(take), expected) << at;
  }
  for (const std::uintmax_t length : {std::uintmax_t{0}, std::uintmax_t{20}, size / 2}) {
    fs::resize_file(cache(), length);
    EXPECT_EQ(MotionSearch(archive()).like(take), expected) << length;
  }
}

TEST_F(MotionSearchTest, ACacheFollowsTheArchive) {
  make_library(6);
  MotionSearch(archive(), keeping_cache());
  const std::string removed = Archive(archive()).takes()[0].name;
  remove_takes(archive(), {removed});
  store({folder_ / "takes" / "s02"}, "more");
  MotionSearch cached(archive());
  const Archive opened(archive());
  fs::remove(cache());
  MotionSearch fresh(archive());
  for (const TakeInfo& take : opened.takes()) {
    const auto results = cached.like(take);
    EXPECT_EQ(results.size(), opened.takes().size() - 1);
    EXPECT_EQ(std::ranges::count(results, removed, &SearchResult::take), 0);
    EXPECT_EQ(results, fresh.like(take));
  }
}

TEST_F(MotionSearchTest, PartsOutsideTheExampleAreUsageErrors) {
  make_library(6);
  MotionSearch search(archive());
  const TakeInfo take = Archive(archive()).takes()[0];
  for (const auto& [from, to] : {std::pair{3.0, 2.0}, {0.0, 1e6}, {1e6, 2e6}, {2.0, 2.0}}) {
    SearchOptions options;
    options.from = from;
    options.to = to;
    try {
      search.like(take, options);
      ADD_FAILURE() << from;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::usage);
    }
  }
}

TEST_F(MotionSearchTest, ReadersSeeOneStateWhileTakesAreAdded) {
  make_takes(8, 4);
  write_takes();
  store({folder_ / "takes" / "s01"});
  const std::size_t before = Archive(archive()).takes().size();
  std::atomic<bool> done = false;
  std::atomic<std::size_t> searches = 0;
  std::vector<std::string> failures(8);
  {
    std::vector<std::jthread> readers;
    for (std::string& failure : failures) {
      readers.emplace_back([&] {
        std::size_t least = before;
        do {
          try {
            MotionSearch search(archive(), with_jobs(1));
            const std::size_t found = search.like(library_.takes[0]).size();
            if (found < least) failure = "takes went away";
            least = found;
            ++searches;
          } catch (const std::exception& error) {
            failure = error.what();
          }
        } while (!done);
      });
    }
    for (const char* subject : {"s02", "s03", "s04"}) store({folder_ / "takes" / subject});
    done = true;
  }
  for (const std::string& failure : failures) EXPECT_EQ(failure, "");
  EXPECT_GE(searches, 8u);
  EXPECT_EQ(MotionSearch(archive()).like(library_.takes[0]).size(), 8u);
}

}  // namespace
}  // namespace reprise
