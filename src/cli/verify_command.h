// reprise verify: reads everything and says what is wrong.
#pragma once

#include "cli/command.h"

namespace reprise::cli {

class VerifyCommand : public Command {
 public:
  std::string name() const override { return "verify"; }
  std::string description() const override {
    return "Check everything: checksums, structure, every clip decodes";
  }
  void setup(CLI::App& app) override;
  ExitCode run(Console& console) override;

 private:
  std::filesystem::path archive_;
  std::filesystem::path against_;
  ReadOptions read_;
};

}  // namespace reprise::cli
