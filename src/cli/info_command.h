// reprise info: everything known of an archive, a take or a clip.
#pragma once

#include "cli/command.h"

namespace reprise::cli {

class InfoCommand : public Command {
 public:
  std::string name() const override { return "info"; }
  std::string description() const override {
    return "Show everything known of the archive, a take or a clip";
  }
  void setup(CLI::App& app) override;
  ExitCode run(Console& console) override;

 private:
  std::filesystem::path archive_;
  std::string id_;
  std::filesystem::path joint_map_;
};

}  // namespace reprise::cli
