// reprise repeats: where motion recurs.
#pragma once

#include <optional>
#include <string>

#include "cli/command.h"

namespace reprise::cli {

class RepeatsCommand : public Command {
 public:
  std::string name() const override { return "repeats"; }
  std::string description() const override {
    return "Find where motion recurs, across takes and subjects";
  }
  void setup(CLI::App& app) override;
  void check() override;
  ExitCode run(Console& console) override;

 private:
  RepeatQuery query_of(const Archive& archive) const;

  std::filesystem::path archive_;
  std::string id_;
  std::optional<double> from_;
  std::optional<double> to_;
  bool across_subjects_ = false;
  double least_seconds_ = 0;
  unsigned jobs_ = 0;
};

}  // namespace reprise::cli
