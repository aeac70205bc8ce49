#include "cli/synth_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "cli/json_output.h"
#include "cli/text.h"
#include "reprise/error.h"

namespace reprise::cli {
namespace {

constexpr std::uint64_t most_takes = 100000;
constexpr std::uint64_t most_subjects = 10000;
constexpr double least_seconds = 1;
constexpr double longest_take_seconds = 3600;

}  // namespace

void SynthCommand::setup(CLI::App& app) {
  add_path(app, "DIR", folder_, "The folder to write, with truth.json", "")->required();
  add_whole_number(app, "--takes", options_.takes, 1, most_takes, "Number of takes (default 24)");
  add_number(app, "--seconds", options_.seconds, least_seconds, longest_take_seconds,
             "Mean length of a take (default 12)");
  add_whole_number(app, "--subjects", options_.subjects, 1, most_subjects,
                   "Number of subjects (default 4)");
  add_whole_number(app, "--seed", options_.seed, 0, std::numeric_limits<std::uint64_t>::max(),
                   "The same seed gives the same library (default 1)");
  app.add_option_function<std::string>(
         "--format",
         [this](const std::string& text) { options_.format = parse_motion_format(text); },
         "bvh (default) or amc")
      ->type_name("FORMAT");
  app.add_flag("--overwrite", overwrite_, "Replace files that exist");
  add_examples(app,
               {"reprise synth takes/", "reprise synth takes/ --takes 8 --subjects 2 --seed 7"});
}

ExitCode SynthCommand::run(Console& console) {
  const std::size_t files = write_synthetic_library(folder_, options_, overwrite_);
  console.message(
      fmt::format("{} written to {}", format_count(files, "file"), printable(folder_.string())));
  console.document({{"folder", folder_.string()},
                    {"files", files},
                    {"takes", options_.takes},
                    {"subjects", std::min(options_.subjects, options_.takes)},  // one take each
                    {"seconds", options_.seconds},
                    {"seed", options_.seed},
                    {"format", format_name(options_.format)}});
  return exit_done;
}

}  // namespace reprise::cli
