// Where a command's words go: results to stdout, everything else to stderr.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "cli/progress_bar.h"
#include "reprise/archive.h"

namespace reprise::cli {

/// Fields in the order in which they are added.
using Json = nlohmann::ordered_json;

/// What every command takes.
struct ConsoleOptions {
  bool quiet = false;
  bool verbose = false;
  bool json = false;
  std::string color = "auto";  ///< "auto" or "never"
};

class Console {
 public:
  explicit Console(const ConsoleOptions& options);

  bool json() const { return options_.json; }
  bool verbose() const { return options_.verbose; }
  bool quiet() const { return options_.quiet; }
  bool bold_results() const { return bold_results_; }

  /// Text for people on stdout; nothing with --json.
  void result(std::string_view text) const;
  /// The one document of --json on stdout; nothing without it.
  void document(const Json& json) const;
  /// Bytes on stdout, as they are.
  void bytes(std::string_view bytes) const;

  /// One line on stderr; not with --quiet.
  void message(std::string_view line) const;
  /// One line on stderr with --verbose.
  void detail(std::string_view line) const;
  /// One line on stderr, always.
  void complaint(std::string_view line) const;

  /// The terminal for a progress bar, or null where there shall be none.
  std::FILE* progress_terminal() const;

  /// Throws Error (failed or limit) where stdout could not take all that was written.
  void flush() const;

 private:
  void to_stdout(std::string_view text) const;

  ConsoleOptions options_;
  mutable int stdout_error_ = 0;  ///< errno of what stdout did not take first
  bool bold_results_ = false;
  bool bold_messages_ = false;
};

/// A document as --json prints it.
std::string text_of(const Json& document);

/// A sink that draws the progress, says once that it waits for other processes, and asks to stop
/// once a signal has come.
ProgressSink progress_sink(ProgressBar& bar, const Console& console);

}  // namespace reprise::cli
