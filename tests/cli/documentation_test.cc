// The examples of docs/cli.md work as they stand there.
#include "cli/command_runner.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

class DocumentationTest : public CommandTest {};

struct Example {
  std::string line;
  int exit_code = 0;
};

/// The lines of the blocks that are marked ```sh. "# exit N" at the end of a line tells its exit
/// code.
std::vector<Example> examples_of(const std::string& document) {
  std::vector<Example> examples;
  bool inside = false;
  for (const std::string& line : lines_of(document)) {
    if (line.starts_with("```")) {
      inside = line == "```sh";
      continue;
    }
    if (!inside || line.empty()) continue;
    constexpr std::string_view mark = "# exit ";
    const auto at = line.find(mark);
    const int code = at == std::string::npos ? 0 : std::stoi(line.substr(at + mark.size()));
    examples.push_back({line, code});
  }
  return examples;
}

TEST_F(DocumentationTest, ExamplesRunInOrder) {
  const auto examples = examples_of(read_file(REPRISE_CLI_DOCUMENT));
  ASSERT_GE(examples.size(), 10U);
  const std::string path = fs::path(REPRISE_COMMAND).parent_path().string() + ":/usr/bin:/bin";
  const Surroundings surroundings{.environment = {{"PATH", path}}, .input = {}};
  for (const Example& example : examples) {
    const Outcome outcome =
        RunningCommand(folder(), {"sh", "-c", example.line}, surroundings).wait();
    EXPECT_EQ(outcome.exit_code, example.exit_code) << example.line << "\n" << outcome.err;
  }
}

}  // namespace
}  // namespace reprise::cli
