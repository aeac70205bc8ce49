// Options with values that several commands take, and how their values are read.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/console.h"
#include "reprise/formats/motion_file.h"

namespace reprise::cli {

/// The whole of `text` as a number from `least` to `most`. Throws Error (usage) that names
/// `option`. Independent of the locale; no hexadecimal, no infinity.
double parse_number(std::string_view option, std::string_view text, double least, double most);
std::uint64_t parse_whole_number(std::string_view option, std::string_view text,
                                 std::uint64_t least, std::uint64_t most);

/// A half-open interval "A:B", "A:" or ":B".
template <typename T>
struct Interval {
  std::optional<T> begin;
  std::optional<T> end;
};

/// Throw Error (usage) where the text is no interval or holds nothing.
Interval<long> parse_frame_interval(std::string_view option, std::string_view text);
Interval<double> parse_time_interval(std::string_view option, std::string_view text);

/// "preview", "standard", "fine" or "exact". Throws Error (usage).
FidelityTier parse_tier(std::string_view text);

/// "bvh" or "amc". Throws Error (usage).
MotionFormat parse_motion_format(std::string_view text);

/// The frames in the interval, or those whose times at `frame_rate` are in it. Sides that are
/// left out are those of `whole`. Throws Error (usage) where the result is empty or goes beyond
/// `whole`.
FrameRange frames_of(const Interval<long>& interval, FrameRange whole);
FrameRange frames_of(const Interval<double>& interval, FrameRange whole, double frame_rate);

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

/// --asf, --unit-mm, --fps: what motion files do not say themselves.
void add_read_options(CLI::App& app, ReadOptions& options);

/// The arguments as the parser wants them, last first. It takes "[a,b]" for a list of two and
/// forgets "--" once it has what it needs; so what is no option though it may look like one gets a
/// NUL in front, which no argument has by itself, and loses it again in the options of `app`.
std::vector<std::string> protected_arguments(int argc, char** argv);
std::string restored_argument(std::string argument);
void restore_arguments(CLI::App& app);

/// "Example:" and the lines, indented, for the end of a command's help.
void add_examples(CLI::App& app, const std::vector<std::string>& lines);

}  // namespace reprise::cli
