// What a terminal gets, and only a terminal: progress and bold headings.
#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include "cli/command_runner.h"

namespace reprise::cli {
namespace {

class TerminalTest : public CommandTest {
 protected:
  /// Runs a command line in a terminal of its own by script(1); gives all that was drawn on it.
  std::string drawn(const std::string& arguments, const std::string& no_color = "") const {
    const Surroundings surroundings{
        .environment = {{"TERM", "xterm"}, {"NO_COLOR", no_color}, {"SHELL", "/bin/sh"}},
        .input = {}};
    const std::string line = std::string(REPRISE_COMMAND) + " " + arguments;
    const Outcome outcome =
        RunningCommand(folder(), {"script", "-qec", line, "/dev/null"}, surroundings).wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    return outcome.out;
  }

  void SetUp() override {
    const Outcome outcome = RunningCommand(folder(), {"sh", "-c", "command -v script"}).wait();
    if (outcome.exit_code != 0) GTEST_SKIP() << "script(1) is not installed";
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
    if (terminal < 0) GTEST_SKIP() << "this system gives no pseudo-terminal (is devpts mounted?)";
    close(terminal);
  }
};

TEST_F(TerminalTest, ProgressIsDrawnUnlessQuiet) {
  output({"synth", "takes", "--takes", "3", "--seconds", "2"});
  EXPECT_NE(drawn("ingest a.rpz takes").find("ingest [#"), std::string::npos);
  EXPECT_EQ(drawn("ingest b.rpz takes --quiet").find("ingest ["), std::string::npos);
}

TEST_F(TerminalTest, HeadingsAreBoldUnlessColourIsUnwanted) {
  make_library();
  const std::string bold = "\033[1mTAKE";
  EXPECT_NE(drawn("list lib.rpz").find(bold), std::string::npos);
  EXPECT_EQ(drawn("list lib.rpz --color never").find('\033'), std::string::npos);
  EXPECT_EQ(drawn("list lib.rpz", "1").find('\033'), std::string::npos);
}

}  // namespace
}  // namespace reprise::cli
