#include "reprise/formats/motion_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <istream>
#include <new>
#include <utility>
#include <vector>

#include "formats/text_lines.h"
#include "reprise/error.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<MotionFormat, std::string_view>, 2> motion_endings = {
    {{MotionFormat::bvh, ".bvh"}, {MotionFormat::asf_amc, ".amc"}}};
constexpr std::string_view skeleton_ending = ".asf";

/// With the point; also of a name that is nothing else.
std::string ending_of(const fs::path& path) {
  const std::string name = path.filename().string();
  return path.has_extension() ? path.extension().string() : name;
}

[[noreturn]] void reject(const fs::path& path, const std::string& why,
                         const std::string& advice = {}) {
  throw Error(ErrorCode::rejected_input, why, {path.string()}, advice);
}

[[noreturn]] void reject_size(const fs::path& path) {
  reject(path, "the file is larger than " + std::to_string(InputLimits::file_bytes) + " bytes",
         "cut it into shorter takes");
}

}  // namespace

std::string_view file_ending(MotionFormat format) {
  return std::ranges::find(motion_endings, format, [](const auto& row) { return row.first; })
      ->second;
}

std::optional<MotionFormat> motion_format_of(const fs::path& path) {
  const std::string own = ending_of(path);
  for (const auto& [format, ending] : motion_endings) {
    if (equal_ignoring_case(own, ending)) return format;
  }
  return std::nullopt;
}

bool is_motion_file(const fs::path& path) { return motion_format_of(path).has_value(); }

bool is_resource_fork(const fs::path& path) { return path.filename().string().starts_with("._"); }

bool is_skeleton_file(const fs::path& path) {
  return equal_ignoring_case(path.extension().string(), skeleton_ending);
}

std::string read_whole_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) reject(path, "this is a folder, not a file");
  std::ifstream file(path, std::ios::binary);
  if (!file && errno == ENOMEM) throw std::bad_alloc();
  if (!file) {
    reject(path, std::string("the file cannot be opened: ") + std::strerror(errno),
           "make it readable, or leave it out");
  }
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > InputLimits::file_bytes) reject_size(path);
  std::string text = read_stream(file, path.string());
  if (file.bad()) reject(path, "the file cannot be read", "copy it again, or leave it out");
  return text;
}

std::string read_stream(std::istream& stream, const std::string& name) {
  std::string text;
  std::vector<char> block(1 << 16);
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())),
         stream.gcount() > 0) {
    const auto count = static_cast<std::size_t>(stream.gcount());
    if (count > InputLimits::file_bytes - text.size()) reject_size(name);
    text.append(block.data(), count);
  }
  return text;
}

Take read_motion_file(const fs::path& path, const ReadOptions& options) {
  const std::optional<MotionFormat> format = motion_format_of(path);
  if (!format) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) reject(path, "there is no such file");
    if (fs::is_directory(path, ignored)) reject(path, "this is a folder, not a file");
    reject(path, "the name ends neither in .bvh nor in .amc", "only BVH and ASF/AMC are read");
  }
  const std::string text = read_whole_file(path);
  if (format == MotionFormat::bvh) {
    return read_bvh(text, path.string(),
                    options.bvh_millimetres_per_unit.value_or(default_millimetres_per_unit),
                    options.frame_rate, options.partial);
  }
  auto skeleton = std::make_shared<const Skeleton>(read_asf_file(asf_of(path, options)));
  return read_amc(text, path.string(), std::move(skeleton), options.frame_rate, options.partial);
}

}  // namespace reprise
