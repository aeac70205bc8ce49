#include "cli/motion_input.h"

#include <iostream>
#include <memory>

namespace reprise::cli {

Take read_motion_from_stdin(const std::optional<std::filesystem::path>& asf,
                            const ReadOptions& options) {
  const std::string text = read_stream(std::cin, "stdin");
  if (!asf) {
    return read_bvh(text, "stdin",
                    options.bvh_millimetres_per_unit.value_or(default_millimetres_per_unit),
                    options.frame_rate, options.partial);
  }
  auto skeleton = std::make_shared<const Skeleton>(read_asf_file(*asf));
  return read_amc(text, "stdin", std::move(skeleton), options.frame_rate, options.partial);
}

}  // namespace reprise::cli
