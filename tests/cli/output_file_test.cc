#include "cli/output_file.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>

#include "reprise/error.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

class OutputFile : public testing::Test {
 protected:
  OutputFile() {
    std::string path = (fs::temp_directory_path() / "reprise-output-XXXXXX").string();
    folder_ = mkdtemp(path.data());
  }
  ~OutputFile() override { fs::remove_all(folder_); }

  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST(PathInside, KeepsNamesThatLeadInside) {
  EXPECT_EQ(path_inside("out", "02/02_01.bvh"), fs::path("out/02/02_01.bvh"));
  EXPECT_EQ(path_inside("out", "a..b/...c"), fs::path("out/a..b/...c"));
}

TEST(PathInside, RefusesNamesThatLeadElsewhere) {
  using namespace std::string_literals;
  for (const std::string& name : {""s, "/etc/passwd"s, ".."s, "../x"s, "a/../../x"s, "a/.."s,
                                  "a//b"s, "a/"s, "./a"s, "a\0b"s}) {
    EXPECT_THROW(path_inside("out", name), Error) << name;
  }
}

TEST_F(OutputFile, ReplacesOnlyWhenTold) {
  const fs::path path = folder_ / "a.bvh";
  write_file_atomically(path, "one", false);
  EXPECT_THROW(write_file_atomically(path, "two", false), Error);
  EXPECT_TRUE(OutputFolder::of(path).has("a.bvh", "one"));
  write_file_atomically(path, "two", true);
  EXPECT_TRUE(OutputFolder::of(path).has("a.bvh", "two"));
  EXPECT_FALSE(OutputFolder::of(path).has("a.bvh", "tw"));
  EXPECT_FALSE(OutputFolder::of(path).has("a.bvh", "twofold"));
  EXPECT_EQ(entries(), 1U) << "a temporary file was left";
}

TEST_F(OutputFile, HasTheRightsOfAnyNewFile) {
  const mode_t mask = umask(022);
  write_file_atomically(folder_ / "a", "x", false);
  umask(mask);
  EXPECT_EQ(fs::status(folder_ / "a").permissions(), fs::perms(0644));
}

TEST_F(OutputFile, LeavesDevicesAndFoldersAlone) {
  fs::create_directory(folder_ / "sub");
  EXPECT_THROW(write_file_atomically(folder_ / "sub", "x", true), Error);
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(write_file_atomically(folder_ / "pipe", "x", true), Error);
  EXPECT_EQ(fs::status(folder_ / "pipe").type(), fs::file_type::fifo);
}

TEST_F(OutputFile, DoesNotFollowLinksOutOfTheFolder) {
  fs::create_directory(folder_ / "real");
  fs::create_directory_symlink("/tmp", folder_ / "link");
  OutputFolder::below(folder_, "real/new/a.bvh").write("a.bvh", "x", false);
  EXPECT_TRUE(fs::exists(folder_ / "real/new/a.bvh"));
  EXPECT_THROW(OutputFolder::below(folder_, "link/a.bvh"), FileError);
  EXPECT_THROW(OutputFolder::below(folder_, "link/new/a.bvh"), FileError);
  EXPECT_THROW(OutputFolder::below(folder_, "real/new/a.bvh/b.bvh"), FileError);
}

TEST_F(OutputFile, ALinkThatComesBetweenLeadsNowhereElse) {
  const fs::path elsewhere = folder_ / "elsewhere", inside = folder_ / "out" / "sub";
  fs::create_directories(elsewhere);
  const OutputFolder folder = OutputFolder::below(folder_ / "out", "sub/a.bvh");
  fs::rename(inside, folder_ / "moved");
  fs::create_directory_symlink(elsewhere, inside);
  folder.write("a.bvh", "x", false);
  EXPECT_TRUE(fs::is_empty(elsewhere));
  EXPECT_TRUE(fs::exists(folder_ / "moved" / "a.bvh"));
}

TEST_F(OutputFile, AnArchiveIsNotReplacedUnderAnyName) {
  write_file_atomically(folder_ / "lib.rpz", "archive", false);
  fs::create_hard_link(folder_ / "lib.rpz", folder_ / "other.bvh");
  fs::create_symlink("lib.rpz", folder_ / "link.bvh");
  for (const char* name : {"lib.rpz", "other.bvh", "link.bvh"})
    EXPECT_THROW(refuse_archive(folder_ / name, folder_ / "lib.rpz"), FileError) << name;
  EXPECT_NO_THROW(refuse_archive(folder_ / "new.bvh", folder_ / "lib.rpz"));
}

}  // namespace
}  // namespace reprise::cli
