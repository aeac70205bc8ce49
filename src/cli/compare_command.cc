#include "cli/compare_command.h"

#include <fmt/format.h>

#include <cmath>

#include "cli/json_output.h"
#include "cli/motion_input.h"
#include "cli/text.h"
#include "reprise/error.h"
#include "reprise/query/take_reading.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

/// The take on stdin, in the format of the other file and, if that is AMC, with its skeleton.
Take read_motion_beside(const fs::path& other, const ReadOptions& options) {
  if (motion_format_of(other) != MotionFormat::asf_amc)
    return read_motion_from_stdin(std::nullopt, options);
  return read_motion_from_stdin(asf_of(other, options), options);
}

Take read_side(const fs::path& path, const fs::path& other, const ReadOptions& options) {
  return path == "-" ? read_motion_beside(other, options) : read_motion_file(path, options);
}

/// Reads both as they are meant: those of one skeleton text alike, whatever one of them does.
void read_both_as_meant(Take& original, Take& decoded, const ReadOptions& options) {
  read_as_meant(original, options);
  if (decoded.skeleton->source_text == original.skeleton->source_text) {
    decoded.skeleton = original.skeleton;
  } else {
    read_as_meant(decoded, options);
  }
}

/// Frame rates that differ by less are one rate in other decimals.
constexpr double rate_tolerance = 1e-3;

/// What is measured all the same, though it may not have been meant.
void warn_of_differences(const Take& original, const Take& decoded, const Console& console) {
  const double rate = original.frame_rate;
  if (std::abs(decoded.frame_rate - rate) > rate_tolerance * rate) {
    console.message(
        fmt::format("the frame rates differ, {:.6g} and {:.6g} Hz; frames are compared one by one",
                    rate, decoded.frame_rate));
  }
  const double unit = original.skeleton->millimetres_per_unit;
  if (decoded.skeleton->millimetres_per_unit != unit) {
    console.message(fmt::format("the units are taken for {:.6g} and {:.6g} mm; --unit-mm says one",
                                unit, decoded.skeleton->millimetres_per_unit));
  }
  for (std::size_t j = 0; j < original.skeleton->joints.size(); ++j) {
    const std::string& name = original.skeleton->joints[j].name;
    const std::string& other = decoded.skeleton->joints[j].name;
    if (name == other) continue;
    console.message(printable(fmt::format(
        "the names of joints differ, such as '{}' and '{}'; joints are compared in their order",
        name, other)));
    return;
  }
}

std::string place_text(const Take& take, const JointAt& at) {
  return fmt::format("{}, frame {}, {:.3f} s", joint_label(*take.skeleton, at.joint), at.frame,
                     static_cast<double>(at.frame) / take.frame_rate);
}

std::string comparison_text(const Comparison& comparison, const Take& original) {
  Table table({{"", Table::Align::left}, {"", Table::Align::right}});
  table.add({"frames", std::to_string(comparison.frames)});
  table.add({"missing frames", std::to_string(comparison.missing_frames)});
  table.add({"mean", format_number(comparison.errors.mean, 3) + " mm"});
  table.add({"rms", format_number(comparison.errors.rms, 3) + " mm"});
  table.add({"p99", format_number(comparison.errors.p99, 3) + " mm"});
  table.add({"max", format_number(comparison.errors.max, 3) + " mm"});
  table.add({"max is at", printable(place_text(original, comparison.worst_place))});
  table.add({"turns, mean", format_number(comparison.turns.mean, 3) + " deg"});
  table.add({"turns, p99", format_number(comparison.turns.p99, 3) + " deg"});
  table.add({"turns, max", format_number(comparison.turns.max, 3) + " deg"});
  table.add({"turns, max is at", printable(place_text(original, comparison.worst_turn))});
  table.add({"local turns, max", format_number(comparison.local_turns.max, 3) + " deg"});
  table.add({"d", format_number(comparison.d_percent, 3) + " %"});
  if (comparison.foot_skate) {
    table.add(
        {"foot skate, original", format_number(comparison.foot_skate->original, 2) + " mm/s"});
    table.add({"foot skate, decoded", format_number(comparison.foot_skate->decoded, 2) + " mm/s"});
  }
  return table.text();
}

}  // namespace

void CompareCommand::setup(CLI::App& app) {
  add_path(app, "ORIGINAL", original_, "A BVH or AMC file, or - for stdin")->required();
  add_path(app, "DECODED", decoded_, "The file to measure, or - for stdin")->required();
  add_read_options(app, read_);
  add_examples(app, {"reprise compare takes/walk_01.bvh out/walk_01.bvh",
                     "reprise extract lib.rpz walk_01 -o - | reprise compare takes/walk_01.bvh -"});
}

void CompareCommand::check() {
  if (original_ == "-" && decoded_ == "-") {
    throw Error(ErrorCode::usage, "only one of ORIGINAL and DECODED can be stdin");
  }
}

ExitCode CompareCommand::run(Console& console) {
  Take original = read_side(original_, decoded_, read_);
  Take decoded = read_side(decoded_, original_, read_);
  read_both_as_meant(original, decoded, read_);
  const Comparison comparison = compare_takes(original, decoded);
  warn_of_differences(original, decoded, console);
  console.result(comparison_text(comparison, original));
  console.document(to_json(comparison, original));
  return exit_done;
}

}  // namespace reprise::cli
