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
  /// What was written. With -d a take that is damaged is added to `damaged`, and the rest goes on.
  Json write_all(const Archive& archive, const std::vector<PlannedExtract>& plan,
                 const std::vector<std::filesystem::path>& targets, std::vector<Damage>& damaged,
                 Console& console) const;

  std::filesystem::path archive_;
  ExtractRequest request_;
  std::filesystem::path file_;
  std::filesystem::path folder_;
  bool overwrite_ = false;
};

}  // namespace reprise::cli
