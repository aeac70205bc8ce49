#include "cli/command_runner.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <iterator>
#include <sstream>

#include "kept_folder.h"

namespace fs = std::filesystem;

extern char** environ;

namespace reprise::cli {
namespace {

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> result;
  for (std::string& word : words) result.push_back(word.data());
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> environment_with(const std::map<std::string, std::string>& more) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (!more.contains(text.substr(0, text.find('=')))) result.push_back(text);
  }
  for (const auto& [name, value] : more) result.push_back(name + "=" + value);
  return result;
}

/// A name that differs where the library or the command that makes it does.
std::string library_key(const std::vector<std::string>& synth,
                        const std::vector<std::string>& ingest) {
  std::string key = program_key(REPRISE_COMMAND);
  for (const std::string& word : synth) key += " " + word;
  key += " ingest";
  for (const std::string& word : ingest) key += " " + word;
  return key;
}

}  // namespace

RunningCommand::RunningCommand(const fs::path& folder, const std::vector<std::string>& words,
                               const Surroundings& surroundings) {
  // Beside the folder, so that nothing turns up in it that the command did not write.
  static std::atomic<int> count = 0;
  const std::string number = std::to_string(++count);
  out_ = folder.string() + ".out" + number;
  err_ = folder.string() + ".err" + number;
  const std::string input =
      surroundings.input.empty() ? "/dev/null" : (folder / surroundings.input).string();

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, input.c_str(), O_RDONLY, 0);
  constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out_.c_str(), flags, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err_.c_str(), flags, 0600);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());

  std::vector<std::string> arguments = words;
  std::vector<std::string> environment = environment_with(surroundings.environment);
  const int result = posix_spawnp(&process_, words.front().c_str(), &actions, nullptr,
                                  pointers(arguments).data(), pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  if (result != 0) throw std::runtime_error("cannot run " + words.front());
}

RunningCommand::~RunningCommand() {
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  std::error_code ignored;
  fs::remove(out_, ignored);
  fs::remove(err_, ignored);
}

void RunningCommand::signal(int number) const { kill(process_, number); }

Outcome RunningCommand::wait() {
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = read_file(out_);
  outcome.err = read_file(err_);
  return outcome;
}

CommandTest::CommandTest() {
  std::string path = (fs::temp_directory_path() / "reprise-cli-XXXXXX").string();
  if (mkdtemp(path.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = path;
}

CommandTest::~CommandTest() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

Outcome CommandTest::reprise(std::vector<std::string> arguments,
                             const Surroundings& surroundings) const {
  arguments.insert(arguments.begin(), REPRISE_COMMAND);
  return RunningCommand(folder_, arguments, surroundings).wait();
}

std::string CommandTest::output(const std::vector<std::string>& arguments) const {
  const Outcome outcome = reprise(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << arguments.front() << ": " << outcome.err;
  return outcome.out;
}

nlohmann::json CommandTest::document(std::vector<std::string> arguments, int exit_code) const {
  arguments.insert(arguments.begin() + 1, "--json");
  const Outcome outcome = reprise(arguments);
  EXPECT_EQ(outcome.exit_code, exit_code) << arguments.front() << ": " << outcome.err;
  const auto parsed = nlohmann::json::parse(outcome.out, nullptr, false);
  EXPECT_FALSE(parsed.is_discarded()) << "not one JSON document: " << outcome.out;
  return parsed;
}

void CommandTest::make_library(const std::string& format) const {
  make_library({"--takes", "4", "--seconds", "3", "--subjects", "2", "--format", format}, {});
}

void CommandTest::make_library(const std::vector<std::string>& synth,
                               const std::vector<std::string>& ingest) const {
  fill_or_copy(fs::path(REPRISE_TEST_LIBRARIES) / library_key(synth, ingest), folder_, [&] {
    std::vector<std::string> words = {"synth", "takes"};
    words.insert(words.end(), synth.begin(), synth.end());
    output(words);
    words = {"ingest", "lib.rpz", "takes"};
    words.insert(words.end(), ingest.begin(), ingest.end());
    output(words);
    return !HasFailure();
  });
}

std::vector<std::string> CommandTest::take_names(const std::string& archive) const {
  std::vector<std::string> names;
  const auto list = document({"list", archive});
  for (const auto& take : list.at("takes")) names.push_back(take.at("name"));
  return names;
}

std::string CommandTest::content_digest(const std::string& archive) const {
  return document({"info", archive}).at("content_digest");
}

std::string read_file(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void write_file(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

std::map<std::string, std::string> files_below(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files[entry.path().lexically_relative(folder).string()] = read_file(entry.path());
    }
  }
  return files;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace reprise::cli
