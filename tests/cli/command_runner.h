// Runs the real command in a folder of its own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace reprise::cli {

struct Outcome {
  int exit_code = -1;  ///< 128 + n where signal n ended it
  std::string out;
  std::string err;
};

/// What a command runs with besides its arguments.
struct Surroundings {
  std::map<std::string, std::string> environment;
  std::filesystem::path input;  ///< file for stdin; empty: nothing
};

/// A running command. Its output goes to files in `folder`, which is its working folder, too.
class RunningCommand {
 public:
  /// `words` with the program first.
  RunningCommand(const std::filesystem::path& folder, const std::vector<std::string>& words,
                 const Surroundings& surroundings = {});
  ~RunningCommand();
  RunningCommand(const RunningCommand&) = delete;
  RunningCommand& operator=(const RunningCommand&) = delete;

  void signal(int number) const;
  Outcome wait();

 private:
  std::filesystem::path out_;
  std::filesystem::path err_;
  int process_ = -1;
};

/// A test with an empty folder, which goes when the test ends.
class CommandTest : public testing::Test {
 protected:
  CommandTest();
  ~CommandTest() override;

  const std::filesystem::path& folder() const { return folder_; }
  Outcome reprise(std::vector<std::string> arguments, const Surroundings& surroundings = {}) const;
  /// Expects exit code 0 and gives stdout.
  std::string output(const std::vector<std::string>& arguments) const;
  /// Runs with --json, expects `exit_code`, and parses stdout as one document.
  nlohmann::json document(std::vector<std::string> arguments, int exit_code = 0) const;

  /// synth into `takes/` and ingest into `lib.rpz`: four short takes of two subjects.
  void make_library(const std::string& format = "bvh") const;
  /// `synth takes SYNTH...`, `ingest lib.rpz takes INGEST...`. Each is done once for a built
  /// command and copied from then on, so that tests which only need a library do not pay for it.
  void make_library(const std::vector<std::string>& synth,
                    const std::vector<std::string>& ingest) const;
  /// Names of the takes of lib.rpz.
  std::vector<std::string> take_names(const std::string& archive = "lib.rpz") const;
  std::string content_digest(const std::string& archive = "lib.rpz") const;

 private:
  std::filesystem::path folder_;
};

std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& text);
/// Relative path and content of every file below.
std::map<std::string, std::string> files_below(const std::filesystem::path& folder);
std::vector<std::string> lines_of(const std::string& text);

}  // namespace reprise::cli
