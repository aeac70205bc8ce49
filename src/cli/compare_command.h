// reprise compare: how far two motion files are apart.
#pragma once

#include "cli/command.h"

namespace reprise::cli {

class CompareCommand : public Command {
 public:
  std::string name() const override { return "compare"; }
  std::string description() const override {
    return "Measure how far a decoded motion file is from its original";
  }
  void setup(CLI::App& app) override;
  void check() override;
  ExitCode run(Console& console) override;

 private:
  std::filesystem::path original_;
  std::filesystem::path decoded_;
  ReadOptions read_;
};

}  // namespace reprise::cli
