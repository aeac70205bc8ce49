// reprise ingest: adds takes to an archive.
#pragma once

#include "cli/command.h"

namespace reprise::cli {

class IngestCommand : public Command {
 public:
  std::string name() const override { return "ingest"; }
  std::string description() const override {
    return "Add takes: files, or folders that are searched through";
  }
  void setup(CLI::App& app) override;
  void check() override;
  ExitCode run(Console& console) override;

 private:
  /// Throws Error (usage) where options exclude each other.
  Fidelity fidelity() const;

  std::filesystem::path archive_;
  IngestOptions options_;
  std::optional<FidelityTier> tier_;
  std::optional<double> bound_mm_, bound_deg_;
  std::optional<double> mean_mm_;
  std::vector<std::string> paths_;
  std::filesystem::path metadata_;
};

}  // namespace reprise::cli
