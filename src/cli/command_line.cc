#include "cli/command_line.h"

#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <csignal>
#include <iostream>
#include <new>
#include <string_view>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/error_report.h"
#include "cli/interruption.h"
#include "cli/suggestion.h"
#include "cli/text.h"

namespace reprise::cli {
namespace {

constexpr std::string_view program_description =
    "Reprise: a small archive for whole motion-capture libraries.";

/// True if --json is among the arguments, for errors that come before they are parsed.
bool asks_for_json(int argc, char** argv) {
  for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i) {
    if (std::string_view(argv[i]) == "--json") return true;
  }
  return false;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  return names;
}

Error usage_error(const std::string& what, const std::string& wrong,
                  const std::vector<std::string>& known, const std::string& help) {
  const auto suggestion = suggest(wrong, known);
  return Error(ErrorCode::usage, what + " \"" + printable(restored_argument(wrong)) + "\"", {},
               suggestion ? "did you mean " + *suggestion + "?" : "see " + help);
}

/// What is wrong with the arguments, in a sentence that helps.
Error explain(const CLI::ParseError& error, const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  const std::string help =
      chosen.empty() ? "reprise --help" : "reprise " + command.get_name() + " --help";
  const std::vector<std::string> rest = command.remaining();
  for (const std::string& argument : rest) {
    if (argument.size() > 1 && argument.front() == '-' && argument != "--") {
      const std::string name = argument.substr(0, argument.find('='));
      return usage_error("unknown option", name, option_names(command), help);
    }
  }
  if (chosen.empty()) {
    if (rest.empty()) return Error(ErrorCode::usage, "a command is missing", {}, "see " + help);
    return usage_error("unknown command", rest.front(), command_names(app), help);
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !rest.empty()) {
    return usage_error("unexpected argument", rest.front(), {}, help);
  }
  return Error(ErrorCode::usage, std::string(error.what()), {}, "see " + help);
}

/// Parses, checks and runs. Throws Error.
ExitCode dispatch(int argc, char** argv, ConsoleOptions& options) {
  CLI::App app{std::string(program_description)};
  app.name("reprise");
  app.set_version_flag("--version", "reprise " REPRISE_VERSION);
  app.require_subcommand(1);
  add_console_options(app, options);
  add_examples(app, {"reprise ingest lib.rpz takes/", "reprise list lib.rpz",
                     "reprise extract lib.rpz walk_01 -o walk_01.bvh"});
  const auto commands = all_commands();
  for (const auto& command : commands) {
    CLI::App* sub = app.add_subcommand(command->name(), command->description());
    command->setup(*sub);
    add_console_options(*sub, options);
    restore_arguments(*sub);
  }
  try {
    app.parse(protected_arguments(argc, argv));
  } catch (const CLI::Success& success) {  // --help and --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    throw explain(error, app);
  }
  for (const auto& command : commands) {
    if (!app.got_subcommand(command->name())) continue;
    command->check();
    Console console(options);
    const ExitCode code = command->run(console);
    console.flush();
    return code;
  }
  return exit_done;
}

}  // namespace

ExitCode run_command_line(int argc, char** argv) {
  // A file that may not grow further is an error of the write then, which leaves the archive whole
  // and is told, instead of the end of the process.
  std::signal(SIGXFSZ, SIG_IGN);
  const bool json = asks_for_json(argc, argv);
  end_where_memory_ends(json);
  try {
    ConsoleOptions options;
    options.json = json;
    const Error interrupted(ErrorCode::interrupted, "interrupted");
    // Over the progress bar, where there is one.
    end_when_interrupted(
        (isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "") + report_line(interrupted) + "\n",
        options.json ? text_of(error_document(interrupted)) : std::string());
    try {
      return dispatch(argc, argv, options);
    } catch (const std::exception& exception) {
      return report(as_error(exception), Console(options));
    }
  } catch (const std::bad_alloc&) {
    return report_out_of_memory(json);
  }
}

}  // namespace reprise::cli
