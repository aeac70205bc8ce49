// reprise plot: pictures of what the archive knows.
#pragma once

#include <string>

#include "cli/command.h"

namespace reprise::cli {

class PlotCommand : public Command {
 public:
  std::string name() const override { return "plot"; }
  std::string description() const override {
    return "Draw a take's key poses, or why motions of it count as repeated";
  }
  void setup(CLI::App& app) override;
  void check() override;
  ExitCode run(Console& console) override;

 private:
  /// Draws, and then tells of what was drawn once the picture is written.
  struct Picture {
    std::string png;
    std::string text;
    Json document;
  };
  Picture self_distance_picture(const Archive& archive, const Console& console) const;
  Picture summary_picture(const Archive& archive, const Console& console) const;

  std::filesystem::path archive_;
  std::string take_;
  std::string summary_;
  std::filesystem::path joint_map_;
  std::filesystem::path file_;
  bool overwrite_ = false;
};

}  // namespace reprise::cli
