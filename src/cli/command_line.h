// The words of a command line: which command is meant, and what comes of it.
#pragma once

#include "cli/error_report.h"

namespace reprise::cli {

/// Finds the command, runs it, tells of errors, and returns the process's exit code.
ExitCode run_command_line(int argc, char** argv);

}  // namespace reprise::cli
