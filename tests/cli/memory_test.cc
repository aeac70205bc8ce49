// Wherever memory runs out, the command ends with exit code 9, and the archive is whole.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "reprise/archive.h"
#include "reprise/error.h"
#include "reprise/synth/library.h"

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
#define REPRISE_COUNTS_MEMORY 1
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#undef REPRISE_COUNTS_MEMORY
#endif
#endif
#endif

namespace {

std::atomic<long> requests = 0;
/// The first request that fails; below 0: none.
std::atomic<long> first_failure = -1;
std::atomic<bool> only_one = false;

/// Threads that the system gives from here on; below 0: as many as it has.
std::atomic<long> threads_left = -1;

/// FLANN does not look at what it gets for its blocks: WindowIndex sees to them beforehand.
constexpr std::size_t block_of_flann = 8192;

[[maybe_unused]] bool fails(std::size_t size) {
  const long request = requests++, first = first_failure;
  const bool now =
      first >= 0 && size != block_of_flann && (only_one ? request == first : request >= first);
  if (now) errno = ENOMEM;
  return now;
}

}  // namespace

#ifdef REPRISE_COUNTS_MEMORY
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) { return fails(size) ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) {
  return fails(count * size) ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  return size > 0 && fails(size) ? nullptr : __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return fails(size) ? nullptr : __libc_memalign(alignment, size);
}
int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*),
                   void* argument) {
  static const auto real =
      reinterpret_cast<decltype(&pthread_create)>(dlsym(RTLD_NEXT, "pthread_create"));
  if (threads_left == 0) return EAGAIN;
  if (threads_left > 0) --threads_left;
  return real(thread, attributes, work, argument);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  *block = fails(size) ? nullptr : __libc_memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}
}
#endif

namespace reprise::cli {
namespace {

namespace fs = std::filesystem;

class MemoryTest : public testing::TestWithParam<bool> {
 protected:
  MemoryTest() {
    std::string path = (fs::temp_directory_path() / "reprise-memory-XXXXXX").string();
    folder_ = mkdtemp(path.data());
    fs::current_path(folder_);
    SynthOptions options;
    options.takes = 2;
    options.seconds = 2;
    options.subjects = 1;
    write_synthetic_library("takes", options, false);
  }
  ~MemoryTest() override {
    fs::current_path("/");
    fs::remove_all(folder_);
  }

  void SetUp() override {
#ifndef REPRISE_COUNTS_MEMORY
    GTEST_SKIP() << "requests for memory are not counted here";
#endif
  }

  /// Exit code of the command in a process of its own, in which a request for memory fails, and
  /// maybe all after it; -n where signal n ended it.
  static int run(std::vector<std::string> words, long failure) {
    const pid_t child = fork();
    if (child == 0) {
      if (std::freopen("/dev/null", "w", stdout) == nullptr) ::_exit(77);
      if (std::freopen("/dev/null", "w", stderr) == nullptr) ::_exit(77);
      words.insert(words.begin(), "reprise");
      std::vector<char*> arguments;
      for (std::string& word : words) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      requests = 0;
      only_one = GetParam();
      first_failure = failure;
      const int code = run_command_line(static_cast<int>(words.size()), arguments.data());
      first_failure = -1;
      // Whether it got so far.
      ::_exit(code == 0 && failure >= 0 && requests <= failure ? 100 : code);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  /// Fails each of the first requests of the command, and then ever fewer of them, until it comes
  /// to its end before. `prepare` and `check` run before and after each.
  template <class Prepare, class Check>
  static void sweep(const std::vector<std::string>& words, const Prepare& prepare,
                    const Check& check) {
    int failed = 0;
    for (long failure = 0;; failure += 1 + failure / 12) {
      prepare();
      const int code = run(words, failure);
      if (code == 100) break;
      // What can do without may: an answer is the same then.
      EXPECT_TRUE(code == 9 || (code == 0 && GetParam())) << "request " << failure << ": " << code;
      failed += code == 9;
      check(code);
      if (HasFailure()) return;
    }
    EXPECT_GT(failed, 40);
  }

  fs::path folder_;
};

TEST_P(MemoryTest, OfAnIngestLeavesAWholeArchive) {
  const std::vector<std::string> words = {"ingest", "lib.rpz", "takes", "--jobs", "2"};
  ASSERT_EQ(run(words, -1), 0);
  const std::string digest = Archive("lib.rpz").info().content_digest;
  sweep(
      words,
      [] {
        fs::remove("lib.rpz");
        fs::remove("lib.rpz-journal");
      },
      [&](int code) {
        if (code == 0) EXPECT_EQ(Archive("lib.rpz").info().content_digest, digest);
        if (fs::exists("lib.rpz")) EXPECT_TRUE(Archive("lib.rpz").verify().ok);
      });
}

TEST_P(MemoryTest, OfASearchChangesNothing) {
  ASSERT_EQ(run({"ingest", "lib.rpz", "takes"}, -1), 0);
  const std::string before = Archive("lib.rpz").info().content_digest;
  sweep(
      {"search", "lib.rpz", "--id", "s01_01", "--from", "0", "--to", "1", "--jobs", "2"}, [] {},
      [&](int) { EXPECT_EQ(Archive("lib.rpz").info().content_digest, before); });
}

TEST_P(MemoryTest, OfAnExtractionLeavesNoFileInPart) {
  ASSERT_EQ(run({"ingest", "lib.rpz", "takes", "--fidelity", "exact"}, -1), 0);
  sweep(
      {"extract", "lib.rpz", "--all", "-d", "out"}, [] { fs::remove_all("out"); },
      [&](int code) {
        std::size_t files = 0;
        if (!fs::exists("out")) return;
        for (const auto& entry : fs::recursive_directory_iterator("out")) {
          if (!entry.is_regular_file()) continue;
          ++files;
          const fs::path source = "takes" / entry.path().lexically_relative("out");
          EXPECT_EQ(read_whole_file(entry.path()), read_whole_file(source)) << source;
        }
        if (code == 0) EXPECT_EQ(files, 2u);
      });
}

// Results do not depend on the number of threads, nor on whether there are any.
TEST_P(MemoryTest, OfThreadsChangesNothing) {
  ASSERT_EQ(run({"ingest", "lib.rpz", "takes", "--jobs", "1"}, -1), 0);
  const std::string digest = Archive("lib.rpz").info().content_digest;
  for (const long threads : {0, 1, 2}) {
    threads_left = threads;
    EXPECT_EQ(run({"ingest", "few.rpz", "takes", "--jobs", "4"}, -1), 0) << threads;
    EXPECT_EQ(run({"search", "few.rpz", "--id", "s01_01", "--jobs", "4"}, -1), 0) << threads;
    EXPECT_EQ(run({"repeats", "few.rpz", "--jobs", "4"}, -1), 0) << threads;
    threads_left = -1;
    EXPECT_EQ(Archive("few.rpz").info().content_digest, digest);
    fs::remove("few.rpz");
  }
}

INSTANTIATE_TEST_SUITE_P(Want, MemoryTest, testing::Bool(), [](const auto& info) {
  return info.param ? std::string("AMoment") : std::string("ForGood");
});

}  // namespace
}  // namespace reprise::cli
