// An ingest that is stopped or killed leaves an archive that is valid, and is carried on by the
// same command.
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "cli/command_runner.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

class InterruptionTest : public CommandTest {
 protected:
  InterruptionTest() {
    output({"synth", "takes", "--takes", "10", "--seconds", "2", "--subjects", "2"});
    const auto start = std::chrono::steady_clock::now();
    output({"ingest", "whole.rpz", "takes", "--jobs", "2"});
    duration_ = std::chrono::steady_clock::now() - start;
    names_ = take_names("whole.rpz");
  }

  /// Sends the signal after a share of the time that an undisturbed ingest takes. Which point of
  /// the work that hits does not matter: everything must hold at every one.
  Outcome ingest_until(int number, double share) const {
    RunningCommand running(folder(),
                           {REPRISE_COMMAND, "ingest", "lib.rpz", "takes", "--jobs", "2"});
    std::this_thread::sleep_for(duration_ * share);
    running.signal(number);
    return running.wait();
  }

  void expect_carried_on() const {
    output({"ingest", "lib.rpz", "takes", "--jobs", "2"});
    EXPECT_EQ(take_names(), names_);
    output({"verify", "lib.rpz", "--against", "takes"});
  }

  std::chrono::duration<double> duration_{};
  std::vector<std::string> names_;
};

TEST_F(InterruptionTest, KilledAnywhereAndCarriedOn) {
  for (const double share : {0.02, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95}) {
    for (const char* name : {"lib.rpz", "lib.rpz-journal"}) fs::remove(folder() / name);
    ingest_until(SIGKILL, share);
    if (fs::exists(folder() / "lib.rpz"))
      EXPECT_EQ(reprise({"verify", "lib.rpz"}).exit_code, 0) << share;
    expect_carried_on();
  }
}

TEST_F(InterruptionTest, StoppedPolitely) {
  for (const int number : {SIGINT, SIGTERM}) {
    fs::remove(folder() / "lib.rpz");
    const Outcome outcome = ingest_until(number, 0.4);
    // A machine under load may have finished before, or not have begun.
    EXPECT_TRUE(outcome.exit_code == 130 || outcome.exit_code == 0 ||
                outcome.exit_code == 128 + number)
        << outcome.exit_code << outcome.err;
    EXPECT_FALSE(fs::exists(folder() / "lib.rpz-journal"));
    expect_carried_on();
  }
}

/// A command that waits for what comes through a pipe: it was begun for certain, and is not done.
class WaitingCommandTest : public CommandTest {
 protected:
  WaitingCommandTest() {
    output({"synth", "takes", "--takes", "2", "--seconds", "2", "--subjects", "1"});
    output({"ingest", "lib.rpz", "takes", "--no-repeats"});
    take_ = take_names().front();
    mkfifo((folder() / "example.bvh").c_str(), 0600);
  }

  /// Runs a command that reads example.bvh, sends it the signal, and then the take.
  Outcome interrupted(const std::vector<std::string>& words, int number) const {
    RunningCommand running(folder(), words);
    const int pipe = open((folder() / "example.bvh").c_str(), O_WRONLY);  // waits for the reader
    running.signal(number);
    write_text(pipe, read_file(folder() / "takes" / (take_ + ".bvh")));
    return running.wait();
  }

 private:
  static void write_text(int pipe, const std::string& text) {
    const auto old = ::signal(SIGPIPE, SIG_IGN);
    for (std::size_t at = 0; at < text.size();) {
      const ssize_t written = write(pipe, text.data() + at, text.size() - at);
      if (written <= 0) break;
      at += static_cast<std::size_t>(written);
    }
    close(pipe);
    ::signal(SIGPIPE, old);
  }

  std::string take_;
};

TEST_F(WaitingCommandTest, EndsWith130WhereItHasNothingToFinish) {
  for (const int number : {SIGINT, SIGTERM}) {
    const Outcome compare =
        interrupted({REPRISE_COMMAND, "compare", "example.bvh", "example.bvh"}, number);
    EXPECT_EQ(compare.exit_code, 130);
    EXPECT_EQ(compare.err, "reprise: interrupted\n");
    const Outcome search = interrupted(
        {REPRISE_COMMAND, "search", "lib.rpz", "--like", "example.bvh", "--json"}, number);
    EXPECT_EQ(search.exit_code, 130);
    const auto error = nlohmann::json::parse(search.out).at("error");
    EXPECT_EQ(error.at("code"), 130);
    EXPECT_EQ(error.at("name"), "interrupted");
  }
}

TEST_F(WaitingCommandTest, EndsWhereWhatItHasToFinishDoesNotEnd) {
  RunningCommand running(
      folder(), {REPRISE_COMMAND, "ingest", "new.rpz", "takes", "--metadata", "example.bvh"});
  const int pipe = open((folder() / "example.bvh").c_str(), O_WRONLY);
  running.signal(SIGTERM);
  const Outcome outcome = running.wait();  // nothing ever comes through the pipe
  close(pipe);
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_EQ(outcome.err, "reprise: interrupted\n");
}

TEST_F(WaitingCommandTest, GoesOnWhereTheSignalIsIgnored) {
  const Outcome outcome = interrupted(
      {"sh", "-c", "trap '' INT; exec \"$0\" search lib.rpz --like example.bvh", REPRISE_COMMAND},
      SIGINT);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

}  // namespace
}  // namespace reprise::cli
