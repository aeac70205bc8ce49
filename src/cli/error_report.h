// How an error is told: a sentence on stderr, an exit code, and a document with --json.
#pragma once

#include "cli/command.h"
#include "reprise/error.h"

namespace reprise::cli {

/// The code that the process ends with. A rejected input ends a command that needs it with
/// "failed".
ExitCode exit_code(ErrorCode code);

/// {"error":{"code","name","message"[,"file"][,"line"][,"advice"]}}
Json error_document(const Error& error);

/// The sentence that is told on stderr.
std::string report_line(const Error& error);

/// Tells it on stderr, and with --json on stdout; returns the exit code.
ExitCode report(const Error& error, const Console& console);

/// The same where there is no memory even for a report: nothing is allocated.
ExitCode report_out_of_memory(bool json);

/// From here on the process ends so, too, where memory runs out in what must not throw, such as the
/// destructor of a JSON document. An archive is whole whenever a process ends.
void end_where_memory_ends(bool json);

/// What an exception means to a user, who knows only Error.
Error as_error(const std::exception& exception);

}  // namespace reprise::cli
