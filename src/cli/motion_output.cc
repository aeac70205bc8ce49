#include "cli/motion_output.h"

#include "cli/output_file.h"
#include "reprise/error.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

/// A name from an archive as one component of a path.
std::string file_name_of(const std::string& stem) {
  if (stem.find('/') != std::string::npos) {
    throw Error(ErrorCode::damaged,
                "the archive names a skeleton in another folder: \"" + stem + "\"");
  }
  return stem + ".asf";
}

}  // namespace

std::vector<fs::path> MotionOutput::write(const Skeleton& skeleton, const std::string& text,
                                          const fs::path& target) {
  std::vector<fs::path> files{target};
  refuse_archive(target, archive_);
  if (skeleton.format == MotionFormat::asf_amc) files.push_back(write_skeleton(skeleton, target));
  write_file_atomically(target, text, overwrite_);
  return files;
}

fs::path MotionOutput::write_skeleton(const Skeleton& skeleton, const fs::path& motion) {
  const std::string stem = skeleton.asf_name.empty() ? motion.stem().string() : skeleton.asf_name;
  fs::path target = path_inside(motion.parent_path(), file_name_of(stem));
  const auto written = written_.find(target.string());
  if (written != written_.end()) {
    if (written->second == skeleton.source_text) return target;
    // Another skeleton of the same name; an ASF with the take's own name is found before any
    // other.
    target = fs::path(motion).replace_extension(".asf");
    const auto other = written_.find(target.string());
    if (other != written_.end() && other->second != skeleton.source_text) {
      throw Error(ErrorCode::failed, "two skeletons of one folder would have this name",
                  {target.string(), 0}, "extract their takes into different folders");
    }
  }
  if (target == motion) {
    throw Error(ErrorCode::failed, "the skeleton and the motion would be one file",
                {target.string(), 0}, "give the motion a name that ends in .amc");
  }
  refuse_archive(target, archive_);
  if (!file_has_content(target, skeleton.source_text)) {
    write_file_atomically(target, skeleton.source_text, overwrite_);
  }
  written_[target.string()] = skeleton.source_text;
  return target;
}

}  // namespace reprise::cli
