// reprise remove: takes out takes.
#pragma once

#include "cli/command.h"

namespace reprise::cli {

class RemoveCommand : public Command {
 public:
  std::string name() const override { return "remove"; }
  std::string description() const override { return "Take out takes, all that are named or none"; }
  void setup(CLI::App& app) override;
  ExitCode run(Console& console) override;

 private:
  std::filesystem::path archive_;
  std::vector<std::string> ids_;
};

}  // namespace reprise::cli
