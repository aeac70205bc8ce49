// A line on the terminal that says how far a command is and how long it still takes.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

#include "reprise/archive.h"

namespace reprise::cli {

/// One line of `columns` columns: "verify [#####-----]  50 %  12/24  0:07 left  walk/03".
std::string progress_line(std::string_view what, const Progress& progress, double elapsed_seconds,
                          std::size_t columns);

/// Draws on a stream that is a terminal, at most ten times a second and when all is done; clears
/// its line when it ends.
class ProgressBar {
 public:
  /// Draws nothing where `terminal` is null.
  ProgressBar(std::string what, std::FILE* terminal);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);
  /// Clears the line until it is shown again.
  void hide();

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  std::FILE* terminal_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_{};
  bool visible_ = false;
};

}  // namespace reprise::cli
