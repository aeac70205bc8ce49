// reprise synth: a library to try things on.
#pragma once

#include "cli/command.h"
#include "reprise/synth/library.h"

namespace reprise::cli {

class SynthCommand : public Command {
 public:
  std::string name() const override { return "synth"; }
  std::string description() const override {
    return "Write a deterministic library of synthetic takes";
  }
  void setup(CLI::App& app) override;
  ExitCode run(Console& console) override;

 private:
  std::filesystem::path folder_;
  SynthOptions options_;
  bool overwrite_ = false;
};

}  // namespace reprise::cli
