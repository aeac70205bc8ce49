// reprise search: which takes hold a motion like an example.
#pragma once

#include "cli/command.h"
#include "reprise/query/motion_search.h"

namespace reprise::cli {

class SearchCommand : public Command {
 public:
  std::string name() const override { return "search"; }
  std::string description() const override { return "Find takes like an example, best first"; }
  void setup(CLI::App& app) override;
  void check() override;
  ExitCode run(Console& console) override;

 private:
  std::filesystem::path archive_;
  std::filesystem::path like_;
  std::string id_;
  std::filesystem::path joint_map_;
  ReadOptions read_;
  SearchSetup setup_;
  SearchOptions options_;
};

}  // namespace reprise::cli
