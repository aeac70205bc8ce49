// reprise stats: what an archive spends its bytes on.
#pragma once

#include "cli/command.h"

namespace reprise::cli {

class StatsCommand : public Command {
 public:
  std::string name() const override { return "stats"; }
  std::string description() const override {
    return "Show sizes by what they are spent on, ratios and errors";
  }
  void setup(CLI::App& app) override;
  ExitCode run(Console& console) override;

 private:
  std::filesystem::path archive_;
};

}  // namespace reprise::cli
