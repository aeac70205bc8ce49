// A writer dies or fails at each step of a change in turn: what it leaves is the archive before the
// change or after it, whatever is found beside it.
#include <sys/wait.h>

#include <cerrno>
#include <functional>
#include <optional>

#include "store/fault_vfs.h"
#include "store/sample_store.h"

namespace reprise {
namespace {

using Change = std::function<void(ArchiveStore&)>;

/// Before the first archive is opened.
[[maybe_unused]] const bool faults_installed = (FaultVfs::install(), true);

fs::path journal_of(const fs::path& archive) { return archive.string() + "-journal"; }

/// Whether there is a journal that says anything: until it is complete it begins with a zero.
bool is_begun(const std::optional<std::string>& journal) {
  return journal && !journal->empty() && journal->front() != '\0';
}

/// A file and what stands beside it.
struct Files {
  std::string archive;
  std::optional<std::string> journal;

  static Files of(const fs::path& path) {
    Files files{read_bytes(path), std::nullopt};
    if (fs::exists(journal_of(path))) files.journal = read_bytes(journal_of(path));
    return files;
  }
  void put(const fs::path& path) const {
    write_bytes(path, archive);
    fs::remove(journal_of(path));
    if (journal) write_bytes(journal_of(path), *journal);
  }
  friend bool operator==(const Files&, const Files&) = default;
};

class Journal : public StoreTest {
 protected:
  Journal() { make_sample(path_, 12); }

  void change(const Change& work) {
    ArchiveStore store = ArchiveStore::open_for_writing(path_);
    work(store);
  }

  /// Whether the change was done, before the process died at a step.
  bool change_until(long step, const Change& work) {
    const pid_t child = fork();
    if (child == 0) {
      FaultVfs::begin({step, 0});
      change(work);
      ::_exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status));
    return WEXITSTATUS(status) == 0;
  }

  /// What a writer leaves that dies at each step of a change in turn.
  std::vector<Files> all_left_by(const Change& work) {
    const Files before = Files::of(path_);
    std::vector<Files> left;
    for (long step = 0;; ++step) {
      before.put(path_);
      const bool done = change_until(step, work);
      left.push_back(Files::of(path_));
      if (done) return left;
    }
  }

  std::string answers() { return everything(ArchiveStore::open_for_reading(path_)); }

  static void commit(ArchiveStore& store, const std::function<void()>& work) {
    store.begin();
    work();
    store.commit();
  }
  static Change adding(int first, int count) {
    return [=](ArchiveStore& store) {
      commit(store, [&] {
        const Ground ground = lay_ground(store);
        for (int i = 0; i < count; ++i) add_sample(store, ground, first + i);
      });
    };
  }
  static Change removing(int number) {
    return [=](ArchiveStore& store) {
      commit(store, [&] {
        store.remove_take(store.find_take(sample_take({}, number).info.name)->info.id);
      });
    };
  }
  static Change compacting() {
    return [](ArchiveStore& store) { store.compact(); };
  }

  /// An archive from which much was removed.
  void make_room() {
    change([](ArchiveStore& store) {
      commit(store, [&] {
        for (int i = 0; i < 9; ++i)
          store.remove_take(store.find_take(sample_take({}, i).info.name)->info.id);
      });
    });
  }

  /// Whatever a writer leaves that dies within a change is what was there before or is there after.
  void expect_whole(const Change& work) {
    const Files begin = Files::of(path_);
    const std::string before = answers();
    change(work);
    const std::string after = answers();
    begin.put(path_);
    const std::vector<Files> all = all_left_by(work);
    EXPECT_GT(all.size(), 5u);
    for (std::size_t step = 0; step < all.size(); ++step) {
      all[step].put(path_);
      SCOPED_TRACE(step);
      const std::string now = answers();
      EXPECT_TRUE(now == before || now == after) << step;
      EXPECT_FALSE(is_begun(Files::of(path_).journal)) << step;
      EXPECT_TRUE(ArchiveStore::open_for_reading(path_).check_structure().empty()) << step;
      all[step].put(path_);
      change(adding(1000, 1));
      EXPECT_TRUE(ArchiveStore::open_for_reading(path_).check_structure().empty()) << step;
      EXPECT_EQ(static_cast<std::int64_t>(fs::file_size(path_)), size_by_header()) << step;
    }
  }

  /// Pages times their size, as the header has them, high byte first.
  std::int64_t size_by_header() {
    const std::string bytes = read_bytes(path_);
    const auto at = [&](std::size_t i) {
      return std::int64_t{static_cast<std::uint8_t>(bytes[i])};
    };
    return (at(16) << 8 | at(17)) * (at(28) << 24 | at(29) << 16 | at(30) << 8 | at(31));
  }

  /// Opens the archive with a journal beside it that is not its own: nothing is changed and the
  /// error says so, or there is nothing in it that would change anything.
  void expect_untouched(const Files& files, const std::string& what) {
    files.put(path_);
    const std::string before = [&] {
      Files alone = files;
      alone.journal.reset();
      alone.put(path_);
      return answers();
    }();
    for (const bool writing : {false, true}) {
      files.put(path_);
      try {
        if (writing) {
          ArchiveStore::open_for_writing(path_);
        } else {
          ArchiveStore::open_for_reading(path_);
        }
        EXPECT_EQ(read_bytes(path_), files.archive) << what;
        EXPECT_EQ(answers(), before) << what;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::damaged) << what;
        EXPECT_NE(error.reason().find(journal_of(path_).filename().string()), std::string::npos)
            << error.what();
        EXPECT_FALSE(error.advice().empty());
        EXPECT_EQ(Files::of(path_), files) << what;
        ++refused_;
      }
    }
  }

  int refused_ = 0;
};

TEST_F(Journal, AWriterThatDiesWhileItAddsLeavesAWholeArchive) { expect_whole(adding(30, 2)); }

TEST_F(Journal, AWriterThatDiesWhileItRemovesLeavesAWholeArchive) { expect_whole(removing(3)); }

TEST_F(Journal, AWriterThatDiesWhileItCompactsLeavesAWholeArchive) {
  make_room();
  expect_whole(compacting());
}

TEST_F(Journal, OneThatDiesWhileItShortensWhatIsLeftLongerLeavesAWholeArchive) {
  make_room();
  const std::vector<Files> all = all_left_by(compacting());
  std::vector<Files> longer;
  for (const Files& left : all) {
    left.put(path_);
    if (!left.journal && left.archive.size() > static_cast<std::size_t>(size_by_header()))
      longer.push_back(left);
  }
  ASSERT_FALSE(longer.empty());
  for (const Files& left : longer) {
    left.put(path_);
    expect_whole(adding(50, 2));
  }
}

TEST_F(Journal, WhatIsLeftUnfinishedIsTakenBackThroughALink) {
  const std::string before = read_bytes(path_);
  const fs::path link = folder_ / "elsewhere" / "link.rpz";
  fs::create_directories(link.parent_path());
  fs::create_symlink(path_, link);
  int taken_back = 0;
  for (const Files& left : all_left_by(adding(30, 2))) {
    if (!is_begun(left.journal) || left.archive == before) continue;
    left.put(path_);
    {
      const ArchiveStore store = ArchiveStore::open_for_reading(link);
      EXPECT_EQ(store.takes({}).size(), 12u);
      EXPECT_TRUE(store.check_structure().empty());
    }
    EXPECT_FALSE(fs::exists(journal_of(path_)));
    ++taken_back;
  }
  EXPECT_GT(taken_back, 0);
}

TEST_F(Journal, ALongerFileOfOtherBytesIsDamaged) {
  const std::string good = read_bytes(path_);
  // Whole pages that were never the archive's.
  for (const char byte : {'\0', 'x'}) {
    for (const std::size_t pages : {1u, 3u}) {
      write_bytes(path_, good + std::string(pages * 1024, byte));
      EXPECT_EQ(code_when_opened(path_), ErrorCode::damaged);
    }
  }
  write_bytes(path_, good + good.substr(0, 1024));
  EXPECT_EQ(code_when_opened(path_), ErrorCode::damaged);
}

TEST_F(Journal, AnotherArchivesIsNotTakenBack) {
  const Files mine = Files::of(path_);
  const fs::path other = path_;
  path_ = folder_ / "other.rpz";
  make_sample(path_, 6);
  const Files theirs = Files::of(path_);
  // Both ways round: the longer of two archives, and the shorter.
  for (const auto& [at_work, beside] : {std::pair{mine, theirs}, std::pair{theirs, mine}}) {
    at_work.put(path_);
    for (const Files& left : all_left_by(adding(30, 2))) {
      if (is_begun(left.journal))
        expect_untouched({beside.archive, left.journal}, "another archive's");
    }
  }
  EXPECT_GT(refused_, 20);
}

TEST_F(Journal, OneOfAnotherStateIsNotTakenBack) {
  const Files before = Files::of(path_);
  change(adding(100, 3));
  const Files base = Files::of(path_);
  change(adding(200, 3));
  const Files later = Files::of(path_);
  change(adding(300, 3));
  const Files much_later = Files::of(path_);
  base.put(path_);
  change(removing(3));
  const Files elsewhere = Files::of(path_);
  base.put(path_);
  const std::vector<Files> all = all_left_by(adding(400, 2));
  for (const Files& left : all) {
    if (!is_begun(left.journal)) continue;
    for (const Files& state : {before, later, much_later, elsewhere})
      expect_untouched({state.archive, left.journal}, "of another state");
    // The state that it was begun from is as good as the file that the writer left.
    Files{base.archive, left.journal}.put(path_);
    EXPECT_EQ(ArchiveStore::open_for_reading(path_).takes({}).size(), 15u);
  }
  EXPECT_GT(refused_, 20);
}

TEST_F(Journal, OtherFilesOfItsNameAreLeftAlone) {
  Files files = Files::of(path_);
  const std::vector<Files> all = all_left_by(adding(30, 2));
  std::string longest;
  for (const Files& left : all) {
    if (is_begun(left.journal)) longest = *left.journal;
  }
  std::string named = longest + std::string(8, '\0');
  named.replace(named.size() - 8, 8, longest.substr(0, 8));
  for (const std::string& bytes :
       {std::string("a text of somebody"), std::string(5000, 'x'), longest.substr(0, 20),
        longest.substr(0, longest.size() - 700), named}) {
    files.journal = bytes;
    expect_untouched(files, std::to_string(bytes.size()));
  }
  EXPECT_EQ(refused_, 10);
}

TEST_F(Journal, ANewArchiveIsNotPutBesideOne) {
  make_room();
  std::optional<std::string> journal;
  for (const Files& left : all_left_by(adding(30, 2))) {
    if (is_begun(left.journal)) journal = left.journal;
  }
  ASSERT_TRUE(journal);
  fs::remove(path_);
  write_bytes(journal_of(path_), *journal);
  EXPECT_THROW(ArchiveStore::open_for_writing(path_), Error);
  EXPECT_FALSE(fs::exists(path_));
  EXPECT_EQ(read_bytes(journal_of(path_)), *journal);
}

TEST_F(Journal, ArchivesKnowThemselvesFromTheirCopies) {
  const std::string one = read_bytes(path_).substr(72, 16);
  EXPECT_NE(one, std::string(16, '\0'));
  change(adding(40, 3));
  make_room();
  change(compacting());
  EXPECT_EQ(read_bytes(path_).substr(72, 16), one);
  fs::remove(path_);
  make_sample(path_, 12);
  EXPECT_NE(read_bytes(path_).substr(72, 16), one);
}

// Else a loss of power brings back the journal of a change that was told to be done, and undoes it.
TEST_F(Journal, ACommitIsDoneOnlyWhenItsJournalIsGoneForGood) {
  make_room();
  for (const Change& work : {adding(40, 3), removing(10), compacting()}) {
    FaultVfs::begin({});
    change(work);
    int removed = 0;
    for (const FileStep& step : FaultVfs::steps()) {
      if (step.kind != FileStep::Kind::remove) continue;
      EXPECT_TRUE(step.lasting) << step.name;
      ++removed;
    }
    EXPECT_EQ(removed, 1);
  }
}

// Whatever fails, the change is told to have failed, or it is done in full.
TEST_F(Journal, FailuresOfTheSystemAreTold) {
  make_room();
  const Files begin = Files::of(path_);
  const std::string before = answers();
  int told = 0;
  for (const Change& work : {adding(40, 2), removing(10), compacting()}) {
    begin.put(path_);
    change(work);
    const Files done = Files::of(path_);
    const std::string after = answers();
    for (const int number : {EIO, ENOSPC}) {
      bool reached = true;
      for (std::size_t step = 0; reached; ++step) {
        begin.put(path_);
        FaultVfs::begin({static_cast<long>(step), number});
        std::optional<Error> error;
        try {
          change(work);
        } catch (const Error& thrown) {
          error = thrown;
        }
        const std::size_t steps = FaultVfs::steps().size();
        reached = step < steps;
        const std::string where = std::to_string(step) + ", errno " + std::to_string(number);
        const FileStep failed = FaultVfs::steps()[std::min(step, steps - 1)];
        FaultVfs::begin({});
        if (error) {
          ++told;
          // What removing a file needs room for, no file system says.
          const bool room = number == ENOSPC && failed.kind != FileStep::Kind::remove;
          const ErrorCode code = room ? ErrorCode::limit : ErrorCode::failed;
          if (number != ENOSPC || room)
            EXPECT_EQ(error->code(), code)
                << where << " of " << failed.name << ": " << error->what();
          const std::string now = answers();
          EXPECT_TRUE(now == before || now == after) << where;
        } else {
          EXPECT_EQ(answers(), after) << where;
          EXPECT_EQ(static_cast<std::int64_t>(fs::file_size(path_)), size_by_header()) << where;
          EXPECT_FALSE(fs::exists(journal_of(path_))) << where;
        }
        EXPECT_TRUE(ArchiveStore::open_for_reading(path_).check_structure().empty()) << where;
      }
    }
  }
  EXPECT_GT(told, 100);
}

}  // namespace
}  // namespace reprise
