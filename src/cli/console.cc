#include "cli/console.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "cli/interruption.h"
#include "reprise/error.h"

namespace reprise::cli {
namespace {

/// https://no-color.org: any value but the empty one means no colour.
bool colour_wanted(const ConsoleOptions& options) {
  const char* no_color = std::getenv("NO_COLOR");
  if (no_color != nullptr && *no_color != '\0') return false;
  const char* terminal = std::getenv("TERM");
  if (terminal != nullptr && std::string_view(terminal) == "dumb") return false;
  return options.color == "auto";
}

void write_line(std::string_view line) {
  const std::string text = std::string(line) + "\n";
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

Console::Console(const ConsoleOptions& options)
    : options_(options),
      bold_results_(colour_wanted(options) && isatty(STDOUT_FILENO) == 1),
      bold_messages_(colour_wanted(options) && isatty(STDERR_FILENO) == 1) {}

void Console::result(std::string_view text) const {
  if (!options_.json) to_stdout(text);
}

void Console::document(const Json& json) const {
  if (options_.json) to_stdout(text_of(json));
}

void Console::bytes(std::string_view bytes) const { to_stdout(bytes); }

void Console::to_stdout(std::string_view text) const {
  withhold_interruption_document();
  errno = 0;
  const std::size_t written = std::fwrite(text.data(), 1, text.size(), stdout);
  if (written < text.size() && stdout_error_ == 0) stdout_error_ = errno;
}

void Console::message(std::string_view line) const {
  if (!options_.quiet) write_line(line);
}

void Console::detail(std::string_view line) const {
  if (options_.verbose && !options_.quiet) write_line(line);
}

void Console::complaint(std::string_view line) const {
  write_line(bold_messages_ ? "\033[31m" + std::string(line) + "\033[0m" : std::string(line));
}

std::FILE* Console::progress_terminal() const {
  return !options_.quiet && isatty(STDERR_FILENO) == 1 ? stderr : nullptr;
}

void Console::flush() const {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  const int error = stdout_error_ != 0 ? stdout_error_ : errno;
  if (error == ENOSPC || error == EDQUOT) {
    throw Error(ErrorCode::limit, "the disk that stdout goes to is full");
  }
  if (error == EFBIG) {
    throw Error(ErrorCode::limit, "the file that stdout goes to reached the limit of its size");
  }
  throw Error(ErrorCode::failed, "the result could not be written to stdout");
}

std::string text_of(const Json& document) {
  // A name need not be UTF-8, a document must be.
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

ProgressSink progress_sink(ProgressBar& bar, const Console& console) {
  return [&bar, &console, told = false](const Progress& progress) mutable {
    if (!progress.waiting) {
      bar.show(progress);
    } else if (!std::exchange(told, true)) {
      bar.hide();
      console.message("waiting until no other process reads the archive");
    }
    return !InterruptionGuard::requested();
  };
}

}  // namespace reprise::cli
