// reprise compact: gives back the space of removed takes.
#pragma once

#include "cli/command.h"

namespace reprise::cli {

class CompactCommand : public Command {
 public:
  std::string name() const override { return "compact"; }
  std::string description() const override { return "Give back the space of removed takes"; }
  void setup(CLI::App& app) override;
  ExitCode run(Console& console) override;

 private:
  std::filesystem::path archive_;
};

}  // namespace reprise::cli
