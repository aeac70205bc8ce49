// Options that several commands take.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/console.h"
#include "cli/option_values.h"
#include "reprise/formats/motion_file.h"

namespace reprise::cli {

/// An option whose value is read by `parse_number` into `target` (double or optional).
template <typename Target>
CLI::Option* add_number(CLI::App& app, const std::string& name, Target& target, double least,
                        double most, const std::string& description) {
  return app
      .add_option_function<std::string>(
          name,
          [=, &target](const std::string& text) { target = parse_number(name, text, least, most); },
          description)
      ->type_name("X");
}

template <typename Target>
CLI::Option* add_whole_number(CLI::App& app, const std::string& name, Target& target,
                              std::uint64_t least, std::uint64_t most,
                              const std::string& description) {
  return app
      .add_option_function<std::string>(
          name,
          [=, &target](const std::string& text) {
            target = static_cast<Target>(parse_whole_number(name, text, least, most));
          },
          description)
      ->type_name("N");
}

/// A name or words. They must not be empty: an empty variable of a script is no wish for all.
CLI::Option* add_text(CLI::App& app, const std::string& name, std::string& target,
                      const std::string& description, const std::string& type);

/// A path that must not be empty.
CLI::Option* add_path(CLI::App& app, const std::string& name, std::filesystem::path& target,
                      const std::string& description, const std::string& type = "FILE");

/// By this path stdin is read as any other file.
inline constexpr const char* stdin_path = "/dev/stdin";

/// A file that is read once; "-" becomes `stdin_path`.
CLI::Option* add_input_file(CLI::App& app, const std::string& name, std::filesystem::path& target,
                            const std::string& description);

/// The archive, first of the positional arguments. It must be seekable, so that "-" is refused.
CLI::Option* add_archive(CLI::App& app, std::filesystem::path& target);

/// Positional arguments, any number of them.
CLI::Option* add_many(CLI::App& app, const std::string& name, std::vector<std::string>& target,
                      const std::string& description);

/// -q, -v, --json, --color.
void add_console_options(CLI::App& app, ConsoleOptions& options);

/// --asf, --unit-mm, --up, --fps, --partial: what motion files do not say themselves.
void add_read_options(CLI::App& app, ReadOptions& options);

/// "Example:" and the lines, indented, for the end of a command's help.
void add_examples(CLI::App& app, const std::vector<std::string>& lines);

}  // namespace reprise::cli
