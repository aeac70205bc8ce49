#include "cli/interruption.h"

#include <signal.h>

#include "reprise/error.h"

namespace reprise::cli {
namespace {

// A signal handler can reach nothing but a global.
volatile sig_atomic_t signal_seen = 0;

extern "C" void note_signal(int) { signal_seen = 1; }

void install(void (*handler)(int), unsigned flags) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(flags);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

InterruptionGuard::InterruptionGuard() {
  signal_seen = 0;
  // Reset after the first, so that an impatient second Ctrl-C ends the process.
  install(note_signal, SA_RESTART | SA_RESETHAND);
}

InterruptionGuard::~InterruptionGuard() { install(SIG_DFL, 0); }

bool InterruptionGuard::requested() { return signal_seen != 0; }

void InterruptionGuard::check() {
  if (requested()) throw Error(ErrorCode::interrupted, "interrupted");
}

}  // namespace reprise::cli
