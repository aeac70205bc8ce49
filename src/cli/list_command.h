// reprise list: what is in an archive.
#pragma once

#include "cli/command.h"

namespace reprise::cli {

class ListCommand : public Command {
 public:
  std::string name() const override { return "list"; }
  std::string description() const override {
    return "List takes, clips, behaviour groups or skeletons";
  }
  void setup(CLI::App& app) override;
  void check() override;
  ExitCode run(Console& console) override;

 private:
  std::filesystem::path archive_;
  TakeFilter filter_;
  bool clips_ = false;
  bool groups_ = false;
  bool skeletons_ = false;
};

}  // namespace reprise::cli
