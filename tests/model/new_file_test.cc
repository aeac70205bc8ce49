// Files that are made under another name: nobody can foretell it, and nobody finds one that is
// left.
#include "model/new_file.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <set>

#include "formats/whole_file.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

class NewFileTest : public testing::Test {
 protected:
  NewFileTest() {
    std::string path = (fs::temp_directory_path() / "reprise-new-XXXXXX").string();
    folder_ = mkdtemp(path.data());
    target_ = folder_ / "lib.rpz";
  }
  ~NewFileTest() override { fs::remove_all(folder_); }

  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_))
      names.insert(entry.path().filename().string());
    return names;
  }
  static void put(const fs::path& path) { std::ofstream(path) << "somebody's"; }

  /// What a process leaves that dies while it makes one.
  fs::path left_by_a_dead_process() const {
    const std::set<std::string> before = names();
    const pid_t child = fork();
    if (child == 0) {
      NewFile file(target_, "it cannot be made");
      put(file.path().string() + "-journal");
      ::_exit(0);
    }
    waitpid(child, nullptr, 0);
    for (const std::string& name : names()) {
      if (!before.contains(name) && !name.ends_with("-journal")) return folder_ / name;
    }
    return {};
  }

  fs::path folder_, target_;
};

TEST_F(NewFileTest, AppearsUnderItsNameWhenItIsComplete) {
  {
    NewFile file(target_, "it cannot be made");
    file.write("text");
    EXPECT_FALSE(fs::exists(target_));
    EXPECT_TRUE(file.place());
  }
  EXPECT_EQ(read_whole_file(target_), "text");
  {
    NewFile other(target_, "it cannot be made");
    EXPECT_FALSE(other.place());
    other.write("more");
    other.replace();
  }
  EXPECT_EQ(read_whole_file(target_), "more");
  { const NewFile unnamed(target_, "it cannot be made"); }
  EXPECT_EQ(names(), std::set<std::string>{"lib.rpz"});
}

TEST_F(NewFileTest, HasANameOfItsOwnEachTime) {
  const NewFile one(target_, "it cannot be made"), two(target_, "it cannot be made");
  EXPECT_NE(one.path(), two.path());
}

TEST_F(NewFileTest, WhatADeadProcessLeftIsTakenAwayAndNothingElse) {
  const fs::path dead = left_by_a_dead_process();
  ASSERT_TRUE(fs::exists(dead));
  const NewFile alive(target_, "it cannot be made");
  const std::set<std::string> others = {"lib.rpz.new-2",
                                        "lib.rpz.new-copy",
                                        "lib.rpz.new-0123456789abcdeX",
                                        "lib.rpz.new-0123456789abcdef0",
                                        "lib.rpz",
                                        "lib.rpz-journal",
                                        "other.rpz.new-0123456789abcdef"};
  for (const std::string& name : others) put(folder_ / name);
  remove_dead_new_files(folder_, "lib.rpz");
  std::set<std::string> expected = others;
  expected.insert(alive.path().filename().string());
  EXPECT_EQ(names(), expected);
}

TEST_F(NewFileTest, LinksAreNotWrittenThrough) {
  put(folder_ / "mine");
  // The name itself, and that which it had until its process could be foretold.
  fs::create_symlink("mine", target_);
  fs::create_symlink("mine", target_.string() + ".new-" + std::to_string(::getpid()));
  write_whole_file(target_, "text");
  EXPECT_EQ(read_whole_file(folder_ / "mine"), "somebody's");
  EXPECT_EQ(read_whole_file(target_), "text");
  EXPECT_FALSE(fs::is_symlink(target_));
}

}  // namespace
}  // namespace reprise
