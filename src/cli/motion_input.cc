#include "cli/motion_input.h"

#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <vector>

#include "reprise/error.h"

namespace reprise::cli {
namespace {

std::string read_stdin() {
  std::string text;
  std::vector<char> block(1 << 16);
  while (std::cin.read(block.data(), static_cast<std::streamsize>(block.size())),
         std::cin.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(std::cin.gcount()));
    if (text.size() > InputLimits::file_bytes) {
      throw Error(ErrorCode::failed,
                  fmt::format("a motion file has at most {} bytes", InputLimits::file_bytes),
                  {"stdin", 0});
    }
  }
  return text;
}

}  // namespace

Take read_motion_from_stdin(const std::optional<std::filesystem::path>& asf,
                            const ReadOptions& options) {
  const std::string text = read_stdin();
  if (!asf)
    return read_bvh(text, "stdin",
                    options.bvh_millimetres_per_unit.value_or(default_millimetres_per_unit));
  auto skeleton = std::make_shared<const Skeleton>(read_asf(read_whole_file(*asf), asf->string()));
  return read_amc(text, "stdin", std::move(skeleton), options.amc_frame_rate);
}

}  // namespace reprise::cli
