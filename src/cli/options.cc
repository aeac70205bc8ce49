#include "cli/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

#include "cli/json_output.h"
#include "cli/text.h"
#include "reprise/error.h"

namespace reprise::cli {
namespace {

// Beyond these no mocap file makes sense; they also keep products of times and rates in range.
constexpr double greatest_millimetres_per_unit = 1e6;
constexpr double greatest_frame_rate = 1e5;
constexpr double greatest_time = 1e9;
/// Part of a frame by which a time given in decimals may miss its frame.
constexpr double frame_tolerance = 1e-6;

[[noreturn]] void refuse(std::string_view option, std::string_view text, std::string_view wanted) {
  throw Error(ErrorCode::usage,
              fmt::format("{} takes {}, not \"{}\"", option, wanted, printable(text)));
}

/// All of `text` by from_chars, or nothing.
template <typename T>
std::optional<T> read_all(std::string_view text) {
  T value{};
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end) return std::nullopt;
  return value;
}

template <typename T>
Interval<T> parse_interval(std::string_view option, std::string_view text, T most) {
  constexpr std::string_view wanted = "an interval A:B with A before B, such as 0:2, 3: or :5";
  const auto colon = text.find(':');
  if (colon == std::string_view::npos) refuse(option, text, wanted);
  const auto side = [&](std::string_view part) -> std::optional<T> {
    if (part.empty()) return std::nullopt;
    const auto value = read_all<T>(part);
    // A NaN fails both comparisons.
    if (!value || !(*value >= 0 && *value <= most)) refuse(option, text, wanted);
    return value;
  };
  const Interval<T> interval{side(text.substr(0, colon)), side(text.substr(colon + 1))};
  if (!interval.begin && !interval.end) refuse(option, text, wanted);
  if (interval.end && interval.begin.value_or(0) >= *interval.end) refuse(option, text, wanted);
  return interval;
}

long first_frame_from(double seconds, double frame_rate) {
  return static_cast<long>(std::ceil(seconds * frame_rate - frame_tolerance));
}

}  // namespace

double parse_number(std::string_view option, std::string_view text, double least, double most) {
  const auto value = read_all<double>(text);
  if (!value || !(*value >= least && *value <= most)) {
    refuse(option, text, fmt::format("a number from {} to {}", least, most));
  }
  return *value;
}

std::uint64_t parse_whole_number(std::string_view option, std::string_view text,
                                 std::uint64_t least, std::uint64_t most) {
  const auto value = read_all<std::uint64_t>(text);
  if (!value || *value < least || *value > most) {
    refuse(option, text, fmt::format("a whole number from {} to {}", least, most));
  }
  return *value;
}

Interval<long> parse_frame_interval(std::string_view option, std::string_view text) {
  return parse_interval<long>(option, text, std::numeric_limits<long>::max());
}

Interval<double> parse_time_interval(std::string_view option, std::string_view text) {
  return parse_interval<double>(option, text, greatest_time);
}

FidelityTier parse_tier(std::string_view text) {
  for (const FidelityTier tier :
       {FidelityTier::preview, FidelityTier::standard, FidelityTier::fine, FidelityTier::exact}) {
    if (text == tier_name(tier)) return tier;
  }
  refuse("--fidelity", text, "preview, standard, fine or exact");
}

MotionFormat parse_motion_format(std::string_view text) {
  for (const MotionFormat format : {MotionFormat::bvh, MotionFormat::asf_amc}) {
    if (text == format_name(format)) return format;
  }
  refuse("--format", text, "bvh or amc");
}

FrameRange frames_of(const Interval<long>& interval, FrameRange whole) {
  const FrameRange range{interval.begin.value_or(whole.begin), interval.end.value_or(whole.end)};
  if (range.begin < whole.begin || range.end > whole.end || range.begin >= range.end) {
    throw Error(ErrorCode::usage,
                fmt::format("frames {}:{} are not within {}:{}, which is what there is",
                            interval.begin ? std::to_string(range.begin) : "",
                            interval.end ? std::to_string(range.end) : "", whole.begin, whole.end));
  }
  return range;
}

FrameRange frames_of(const Interval<double>& interval, FrameRange whole, double frame_rate) {
  const auto side = [&](const std::optional<double>& seconds, long otherwise) {
    return seconds ? first_frame_from(*seconds, frame_rate) : otherwise;
  };
  const FrameRange range{side(interval.begin, whole.begin), side(interval.end, whole.end)};
  const auto text = [](const std::optional<double>& seconds) {
    return seconds ? fmt::format("{:g}", *seconds) : std::string();
  };
  const std::string asked = fmt::format("{}:{} s", text(interval.begin), text(interval.end));
  if (range.begin < whole.begin || range.begin >= whole.end || range.end > whole.end) {
    throw Error(ErrorCode::usage,
                fmt::format("{} are not within {:g}:{:g} s, which is what there is", asked,
                            static_cast<double>(whole.begin) / frame_rate,
                            static_cast<double>(whole.end) / frame_rate));
  }
  if (range.begin >= range.end) {
    throw Error(ErrorCode::usage,
                fmt::format("no frame is within {}: there are {:g} a second", asked, frame_rate));
  }
  return range;
}

CLI::Option* add_path(CLI::App& app, const std::string& name, std::filesystem::path& target,
                      const std::string& description, const std::string& type) {
  return app
      .add_option_function<std::string>(
          name,
          [name, &target](const std::string& text) {
            if (text.empty()) refuse(name, text, "a path");
            target = text;
          },
          description)
      ->type_name(type);
}

CLI::Option* add_input_file(CLI::App& app, const std::string& name, std::filesystem::path& target,
                            const std::string& description) {
  return app
      .add_option_function<std::string>(
          name,
          [name, &target](const std::string& text) {
            if (text.empty()) refuse(name, text, "a path");
            target = text == "-" ? stdin_path : text;
          },
          description)
      ->type_name("FILE");
}

CLI::Option* add_archive(CLI::App& app, std::filesystem::path& target) {
  return app
      .add_option_function<std::string>(
          "ARCHIVE",
          [&target](const std::string& text) {
            if (text.empty()) refuse("ARCHIVE", text, "a path");
            if (text == "-") {
              throw Error(ErrorCode::usage,
                          "an archive cannot come from stdin or go to stdout: it is read and "
                          "written in places");
            }
            target = text;
          },
          "The archive, by habit *.rpz")
      ->type_name("FILE")
      ->required();
}

CLI::Option* add_many(CLI::App& app, const std::string& name, std::vector<std::string>& target,
                      const std::string& description) {
  return app.add_option(name, target, description)->type_name("");
}

void add_console_options(CLI::App& app, ConsoleOptions& options) {
  app.add_flag("-q,--quiet", options.quiet, "No messages and no progress on stderr");
  app.add_flag("-v,--verbose", options.verbose, "More messages on stderr");
  app.add_flag("--json", options.json, "The result as one JSON document on stdout");
  app.add_option_function<std::string>(
         "--color",
         [&options](const std::string& text) {
           if (text != "auto" && text != "never") refuse("--color", text, "auto or never");
           options.color = text;
         },
         "auto (default; only on a terminal) or never; NO_COLOR means never")
      ->type_name("WHEN");
}

void add_read_options(CLI::App& app, ReadOptions& options) {
  app.add_option_function<std::string>(
         "--asf",
         [&options](const std::string& text) {
           if (text.empty() || text == "-") refuse("--asf", text, "a path");
           options.asf = text;
         },
         "The skeleton of AMC files; else the one beside each")
      ->type_name("FILE");
  add_number(app, "--unit-mm", options.bvh_millimetres_per_unit, 1 / greatest_millimetres_per_unit,
             greatest_millimetres_per_unit,
             "Millimetres in a length unit of BVH files (default 10)");
  add_number(app, "--fps", options.amc_frame_rate, 1 / greatest_frame_rate, greatest_frame_rate,
             "Frames a second of AMC files, which do not say (default 120)");
}

std::vector<std::string> protected_arguments(int argc, char** argv) {
  std::vector<std::string> arguments;
  bool options_ended = false;
  for (int i = 1; i < argc; ++i) {
    std::string argument = argv[i];
    if (argument == "--" && !options_ended) {
      options_ended = true;
      continue;
    }
    const bool like_list = argument.starts_with('[') && argument.ends_with(']');
    const bool like_option = options_ended && argument.starts_with('-');
    if (like_list || like_option) argument.insert(argument.begin(), '\0');
    arguments.push_back(std::move(argument));
  }
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

std::string restored_argument(std::string argument) {
  if (argument.starts_with('\0')) argument.erase(argument.begin());
  return argument;
}

void restore_arguments(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) option->transform(restored_argument);
}

void add_examples(CLI::App& app, const std::vector<std::string>& lines) {
  std::string text = "Example:";
  for (const std::string& line : lines) text += "\n  " + line;
  app.footer(text);
}

}  // namespace reprise::cli
