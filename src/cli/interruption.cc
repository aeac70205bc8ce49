#include "cli/interruption.h"

#include <signal.h>
#include <unistd.h>

#include <string_view>

#include "reprise/error.h"

namespace reprise::cli {
namespace {

/// SIGALRM comes when the patience of a guard ends.
constexpr int signals[] = {SIGINT, SIGTERM, SIGALRM};

// A signal handler can reach nothing but globals.
volatile sig_atomic_t guarded = 0;
volatile sig_atomic_t signal_seen = 0;
volatile sig_atomic_t document_withheld = 0;
std::string last_message;
std::string last_document;

void write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

extern "C" void heed_signal(int) {
  if (guarded != 0 && signal_seen == 0) {
    signal_seen = 1;
    alarm(InterruptionGuard::patience_s);
    return;
  }
  write_all(STDERR_FILENO, last_message);
  if (document_withheld == 0) write_all(STDOUT_FILENO, last_document);
  _exit(static_cast<int>(ErrorCode::interrupted));
}

}  // namespace

void end_when_interrupted(const std::string& message, const std::string& document) {
  last_message = message;
  last_document = document;
  for (const int number : signals) {
    struct sigaction action = {};
    sigaction(number, nullptr, &action);
    if (action.sa_handler == SIG_IGN && number != SIGALRM) continue;
    action.sa_handler = heed_signal;
    action.sa_flags = SA_RESTART;
    sigfillset(&action.sa_mask);
    sigaction(number, &action, nullptr);
  }
}

void withhold_interruption_document() { document_withheld = 1; }

InterruptionGuard::InterruptionGuard() {
  signal_seen = 0;
  guarded = 1;
}

InterruptionGuard::~InterruptionGuard() {
  alarm(0);
  guarded = 0;
}

bool InterruptionGuard::requested() { return signal_seen != 0; }

void InterruptionGuard::check() {
  if (requested()) throw Error(ErrorCode::interrupted, "interrupted");
}

}  // namespace reprise::cli
