#include "cli/error_report.h"

#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>

#include "cli/text.h"

namespace reprise::cli {
namespace {

// What ends a process can reach nothing but globals.
bool json_wanted = false;

std::string error_name(ErrorCode code) {
  switch (code) {
    case ErrorCode::failed:
    case ErrorCode::rejected_input:
      return "failed";
    case ErrorCode::usage:
      return "usage";
    case ErrorCode::damaged:
      return "damaged";
    case ErrorCode::newer_version:
      return "newer_version";
    case ErrorCode::locked:
      return "locked";
    case ErrorCode::not_found:
      return "not_found";
    case ErrorCode::limit:
      return "limit";
    case ErrorCode::interrupted:
      return "interrupted";
  }
  return "failed";
}

}  // namespace

ExitCode exit_code(ErrorCode code) {
  if (code == ErrorCode::rejected_input) return static_cast<int>(ErrorCode::failed);
  return static_cast<int>(code);
}

Json error_document(const Error& error) {
  Json fields = {{"code", exit_code(error.code())},
                 {"name", error_name(error.code())},
                 {"message", error.reason()}};
  if (!error.place().file.empty()) fields["file"] = error.place().file;
  if (error.place().line > 0) fields["line"] = error.place().line;
  if (!error.advice().empty()) fields["advice"] = error.advice();
  return {{"error", fields}};
}

std::string report_line(const Error& error) { return "reprise: " + printable(error.what()); }

ExitCode report_out_of_memory(bool json) {
  constexpr std::string_view line = "reprise: out of memory\n";
  constexpr std::string_view document =
      "{\n  \"error\": {\n    \"code\": 9,\n    \"name\": \"limit\",\n    \"message\": \"out of "
      "memory\"\n  }\n}\n";
  static_assert(static_cast<int>(ErrorCode::limit) == 9);
  // Nobody is left to hear that this could not be written.
  (void)!::write(STDERR_FILENO, line.data(), line.size());
  if (json) (void)!::write(STDOUT_FILENO, document.data(), document.size());
  return static_cast<int>(ErrorCode::limit);
}

void end_where_memory_ends(bool json) {
  json_wanted = json;
  std::set_terminate([] {
    if (std::current_exception()) {
      try {
        throw;
      } catch (const std::bad_alloc&) {
        ::_exit(report_out_of_memory(json_wanted));
      } catch (...) {
      }
    }
    std::abort();
  });
}

ExitCode report(const Error& error, const Console& console) {
  console.complaint(report_line(error));
  console.document(error_document(error));
  return exit_code(error.code());
}

Error as_error(const std::exception& exception) {
  if (const auto* known = dynamic_cast<const Error*>(&exception)) return *known;
  if (dynamic_cast<const std::bad_alloc*>(&exception) != nullptr) {
    return Error(ErrorCode::limit, "out of memory");
  }
  if (const auto* system = dynamic_cast<const std::system_error*>(&exception)) {
    const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(system);
    return Error(code_of_errno(system->code().default_error_condition().value()),
                 system->code().message(),
                 {file != nullptr ? file->path1().string() : std::string(), 0});
  }
  return Error(ErrorCode::failed, exception.what());
}

}  // namespace reprise::cli
