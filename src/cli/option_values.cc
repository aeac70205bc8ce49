#include "cli/option_values.h"

#include <fmt/format.h>

#include "cli/json_output.h"
#include "cli/text.h"
#include "reprise/error.h"

namespace reprise::cli {

void refuse_value(std::string_view option, std::string_view text, std::string_view wanted) {
  throw Error(ErrorCode::usage,
              fmt::format("{} takes {}, not \"{}\"", option, wanted, printable(text)));
}

double parse_number(std::string_view option, std::string_view text, double least, double most) {
  const auto value = read_all<double>(text);
  if (!value || !(*value >= least && *value <= most)) {
    refuse_value(option, text, fmt::format("a number from {} to {}", least, most));
  }
  return *value;
}

std::uint64_t parse_whole_number(std::string_view option, std::string_view text,
                                 std::uint64_t least, std::uint64_t most) {
  const auto value = read_all<std::uint64_t>(text);
  if (!value || *value < least || *value > most) {
    refuse_value(option, text, fmt::format("a whole number from {} to {}", least, most));
  }
  return *value;
}

FidelityTier parse_tier(std::string_view text) {
  for (const FidelityTier tier :
       {FidelityTier::preview, FidelityTier::standard, FidelityTier::fine, FidelityTier::exact}) {
    if (text == tier_name(tier)) return tier;
  }
  refuse_value("--fidelity", text, "preview, standard, fine or exact");
}

MotionFormat parse_motion_format(std::string_view text) {
  for (const MotionFormat format : {MotionFormat::bvh, MotionFormat::asf_amc}) {
    if (text == format_name(format)) return format;
  }
  refuse_value("--format", text, "bvh or amc");
}

}  // namespace reprise::cli
