// Many processes read an archive while another one adds to it: each of their answers is a state
// that the archive was in.
#include <algorithm>
#include <memory>

#include "cli/command_runner.h"

namespace reprise::cli {
namespace {

using nlohmann::json;

class ReadersTest : public CommandTest {
 protected:
  static constexpr int readers = 8;

  ReadersTest() {
    make_library();
    output({"synth", "more", "--takes", "6", "--seconds", "2", "--subjects", "2", "--seed", "2"});
  }

  /// Asks again and again until the file `done` is there, and stops at the first failure. Answers
  /// go into files, numbered.
  std::unique_ptr<RunningCommand> reader(int number) const {
    const std::string ask =
        "n=0; while [ $n -eq 0 ] || [ ! -e done ]; do n=$((n + 1)); " REPRISE_COMMAND
        " list --json lib.rpz > " +
        std::to_string(number) + ".$n.json && " REPRISE_COMMAND " verify lib.rpz > " +
        std::to_string(number) + ".verify || { cat " + std::to_string(number) +
        ".verify >&2; exit 1; }; " REPRISE_COMMAND
        " search -q lib.rpz --id s01/s01_01 --top 1 > /dev/null || exit 1; done";
    return std::make_unique<RunningCommand>(folder(), std::vector<std::string>{"sh", "-c", ask});
  }

  /// How many takes each answer of a reader lists; all of those that were there before are in it.
  std::vector<std::size_t> sizes_of_answers(int number, const std::vector<std::string>& before) {
    std::vector<std::size_t> sizes;
    for (int n = 1;; ++n) {
      const auto file = folder() / (std::to_string(number) + "." + std::to_string(n) + ".json");
      if (!std::filesystem::exists(file)) return sizes;
      const json answer = json::parse(read_file(file));
      std::vector<std::string> names;
      for (const json& take : answer["takes"]) names.push_back(take["name"]);
      for (const std::string& name : before) {
        EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
      }
      sizes.push_back(names.size());
    }
  }
};

TEST_F(ReadersTest, SeeWholeStatesDuringAnIngest) {
  const std::vector<std::string> before = take_names();
  std::vector<std::unique_ptr<RunningCommand>> running;
  for (int r = 0; r < readers; ++r) running.push_back(reader(r));
  output({"ingest", "lib.rpz", "more", "--prefix", "more"});
  write_file(folder() / "done", "");
  for (int r = 0; r < readers; ++r) {
    const Outcome outcome = running[static_cast<std::size_t>(r)]->wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::vector<std::size_t> sizes = sizes_of_answers(r, before);
    ASSERT_FALSE(sizes.empty());
    EXPECT_TRUE(std::is_sorted(sizes.begin(), sizes.end()));
    EXPECT_LE(sizes.back(), before.size() + 6);
  }
  EXPECT_EQ(take_names().size(), before.size() + 6);
  output({"verify", "lib.rpz"});
}

}  // namespace
}  // namespace reprise::cli
