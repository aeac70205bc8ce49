// Ctrl-C and a polite kill, for commands that have something to finish first.
#pragma once

namespace reprise::cli {

/// While it lives, SIGINT and SIGTERM set a flag instead of ending the process. The second signal
/// of a kind ends it at once. One at a time.
class InterruptionGuard {
 public:
  InterruptionGuard();
  ~InterruptionGuard();
  InterruptionGuard(const InterruptionGuard&) = delete;
  InterruptionGuard& operator=(const InterruptionGuard&) = delete;

  static bool requested();
  /// Throws Error (interrupted) once a signal has come.
  static void check();
};

}  // namespace reprise::cli
