#include "cli/written_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "cli/json_output.h"
#include "reprise/error.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

/// What can be written, and the format of the sources that it can be written of.
struct WrittenFormat {
  std::string_view ending;
  MotionFormat source;
};

const std::array<WrittenFormat, 2>& written_formats() {
  static const std::array<WrittenFormat, 2> formats = {
      {{file_ending(MotionFormat::bvh), MotionFormat::bvh},
       {file_ending(MotionFormat::asf_amc), MotionFormat::asf_amc}}};
  return formats;
}

/// In lower case; empty where the name has none that could be a format's.
std::string ending_of(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  const bool letters = std::ranges::any_of(ending, [](char c) { return c >= 'a' && c <= 'z'; });
  return letters ? ending : std::string();
}

}  // namespace

void check_written_ending(const fs::path& file) {
  const std::string ending = ending_of(file);
  if (ending.empty() || std::ranges::count(written_formats(), ending, &WrittenFormat::ending) > 0) {
    return;
  }
  std::string known;
  for (const WrittenFormat& format : written_formats()) {
    known += (known.empty() ? "" : " or ") + std::string(format.ending);
  }
  throw Error(ErrorCode::usage, fmt::format("{} files are not written", ending), {file.string(), 0},
              fmt::format("a take comes out in the format of its source: give a name that ends in "
                          "{}",
                          known));
}

void check_written_ending(const fs::path& file, const TakeInfo& take) {
  check_written_ending(file);
  const std::string ending = ending_of(file);
  const auto fits = [&](const WrittenFormat& format) {
    return format.ending == ending && format.source == take.format;
  };
  if (ending.empty() || std::ranges::any_of(written_formats(), fits)) return;
  throw Error(ErrorCode::usage,
              fmt::format("{} comes from {}; it cannot be written as {} yet", take.name,
                          format_name(take.format), ending.substr(1)),
              {file.string(), 0},
              fmt::format("give a name that ends in {}", file_ending(take.format)));
}

}  // namespace reprise::cli
