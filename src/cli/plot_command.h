// reprise plot: pictures of what the archive knows.
#pragma once

#include <string>

#include "cli/command.h"

namespace reprise::cli {

class PlotCommand : public Command {
 public:
  std::string name() const override { return "plot"; }
  std::string description() const override {
    return "Draw why motions of a take count as repeated";
  }
  void setup(CLI::App& app) override;
  ExitCode run(Console& console) override;

 private:
  std::filesystem::path archive_;
  std::string take_;
  std::filesystem::path file_;
  bool overwrite_ = false;
};

}  // namespace reprise::cli
