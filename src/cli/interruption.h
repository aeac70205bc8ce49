// Ctrl-C and a polite kill: they end a command at once, unless it has something to finish first.
#pragma once

#include <string>

namespace reprise::cli {

/// From here on SIGINT and SIGTERM end the process at once with exit code 130, `message` on stderr
/// and `document` on stdout. A signal that the process was started to ignore stays ignored.
void end_when_interrupted(const std::string& message, const std::string& document);
/// Part of a result is on stdout: a document after it would make both unreadable.
void withhold_interruption_document();

/// While it lives, the first SIGINT or SIGTERM sets a flag instead of ending the process; the
/// second ends it at once, and so does the end of patience: a single take may take minutes, and an
/// archive is valid whenever the process dies. One at a time.
class InterruptionGuard {
 public:
  static constexpr unsigned patience_s = 10;

  InterruptionGuard();
  ~InterruptionGuard();
  InterruptionGuard(const InterruptionGuard&) = delete;
  InterruptionGuard& operator=(const InterruptionGuard&) = delete;

  static bool requested();
  /// Throws Error (interrupted) once a signal has come.
  static void check();
};

}  // namespace reprise::cli
