// What all commands have in common, and the list of them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/console.h"
#include "cli/options.h"

namespace reprise::cli {

/// The process's exit code; the values are those of ErrorCode.
using ExitCode = int;
constexpr ExitCode exit_done = 0;

class Command {
 public:
  virtual ~Command() = default;

  virtual std::string name() const = 0;
  virtual std::string description() const = 0;
  /// Declares the arguments; reads each one's value as it is parsed.
  virtual void setup(CLI::App& app) = 0;
  /// What concerns several arguments together. Throws Error (usage). Touches no file.
  virtual void check() {}
  /// Does it. Throws Error.
  virtual ExitCode run(Console& console) = 0;
};

/// In the order of the help.
std::vector<std::unique_ptr<Command>> all_commands();

}  // namespace reprise::cli
