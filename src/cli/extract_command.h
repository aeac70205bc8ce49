// reprise extract: decoded motion out of an archive.
#pragma once

#include "cli/command.h"
#include "cli/extract_plan.h"

namespace reprise::cli {

class ExtractCommand : public Command {
 public:
  std::string name() const override { return "extract"; }
  std::string description() const override {
    return "Write decoded motion, in the format of its source";
  }
  void setup(CLI::App& app) override;
  void check() override;
  ExitCode run(Console& console) override;

 private:
  /// Takes out of the plan what has no place under the folder. Throws Error (failed) where a file
  /// is there already and is not to be replaced.
  void check_targets(ExtractPlan& plan) const;
  /// What was written. With -d what cannot be read or written of a take is added to the plan's
  /// lists, and the rest goes on.
  Json write_all(const Archive& archive, ExtractPlan& plan, Console& console) const;

  std::filesystem::path archive_;
  ExtractRequest request_;
  std::filesystem::path file_;
  std::filesystem::path folder_;
  bool overwrite_ = false;
};

}  // namespace reprise::cli
