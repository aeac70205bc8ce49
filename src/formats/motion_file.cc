#include "reprise/formats/motion_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <vector>

#include "formats/text_lines.h"
#include "reprise/error.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

bool has_extension(const fs::path& path, std::string_view extension) {
  return equal_ignoring_case(path.extension().string(), extension);
}

[[noreturn]] void reject(const fs::path& path, const std::string& why,
                         const std::string& advice = {}) {
  throw Error(ErrorCode::rejected_input, why, {path.string()}, advice);
}

}  // namespace

std::optional<MotionFormat> motion_format_of(const fs::path& path) {
  if (has_extension(path, ".bvh")) return MotionFormat::bvh;
  if (has_extension(path, ".amc")) return MotionFormat::asf_amc;
  return std::nullopt;
}

bool is_motion_file(const fs::path& path) { return motion_format_of(path).has_value(); }

bool is_skeleton_file(const fs::path& path) { return has_extension(path, ".asf"); }

fs::path find_asf(const fs::path& amc) {
  const fs::path folder = amc.parent_path().empty() ? fs::path(".") : amc.parent_path();
  const std::string stem = amc.stem().string();
  std::vector<fs::path> skeletons;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (is_skeleton_file(entry.path())) skeletons.push_back(entry.path());
  }
  for (const std::string& name : {stem, stem.substr(0, stem.find('_'))}) {
    for (const fs::path& path : skeletons) {
      if (path.stem().string() == name) return path;
    }
  }
  if (skeletons.size() == 1) return skeletons[0];
  reject(amc,
         skeletons.empty() ? "there is no ASF skeleton beside it"
                           : "there are several ASF skeletons beside it and none has its name",
         "name one with --asf");
}

std::string read_whole_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) reject(path, "this is a folder, not a file");
  std::ifstream file(path, std::ios::binary);
  if (!file && errno == ENOMEM) throw std::bad_alloc();
  if (!file) reject(path, std::string("the file cannot be opened: ") + std::strerror(errno));
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > InputLimits::file_bytes) {
    reject(path, "the file is larger than " + std::to_string(InputLimits::file_bytes) + " bytes");
  }
  std::string text;
  if (!error) text.reserve(size);
  std::vector<char> block(1 << 16);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > InputLimits::file_bytes) reject(path, "the file is too large");
  }
  if (file.bad()) reject(path, "the file cannot be read");
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
                    options.bvh_millimetres_per_unit.value_or(default_millimetres_per_unit));
  }
  const fs::path asf = options.asf ? *options.asf : find_asf(path);
  auto skeleton = std::make_shared<Skeleton>(read_asf(read_whole_file(asf), asf.string()));
  skeleton->asf_name = asf.stem().string();
  return read_amc(text, path.string(), std::move(skeleton), options.amc_frame_rate);
}

}  // namespace reprise
