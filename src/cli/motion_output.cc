#include "cli/motion_output.h"

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
                                          const OutputFolder& folder, const std::string& name) {
  std::vector<fs::path> files{folder.path() / name};
  folder.refuse_archive(name, archive_);
  folders_.insert(folder.path());
  if (skeleton.format == MotionFormat::asf_amc) {
    files.push_back(write_skeleton(skeleton, folder, name));
  }
  folder.write(name, text, overwrite_);
  return files;
}

fs::path MotionOutput::write_skeleton(const Skeleton& skeleton, const OutputFolder& folder,
                                      const std::string& motion) {
  const std::string stem =
      skeleton.asf_name.empty() ? fs::path(motion).stem().string() : skeleton.asf_name;
  fs::path target = path_inside(folder.path(), file_name_of(stem));
  const auto written = written_.find(target.string());
  if (written != written_.end()) {
    if (written->second == skeleton.source_text) return target;
    // Another skeleton of the same name; an ASF with the take's own name is found before any
    // other.
    target = (folder.path() / motion).replace_extension(".asf");
    const auto other = written_.find(target.string());
    if (other != written_.end() && other->second != skeleton.source_text) {
      throw FileError(ErrorCode::failed, "two skeletons of one folder would have this name",
                      {target.string(), 0}, "extract their takes into different folders");
    }
  }
  const std::string name = target.filename().string();
  if (name == motion) {
    throw FileError(ErrorCode::failed, "the skeleton and the motion would be one file",
                    {target.string(), 0}, "give the motion a name that ends in .amc");
  }
  folder.refuse_archive(name, archive_);
  if (!folder.has(name, skeleton.source_text)) {
    folder.write(name, skeleton.source_text, overwrite_);
  }
  written_[target.string()] = skeleton.source_text;
  return target;
}

void MotionOutput::sync(const fs::path& top) const {
  std::set<fs::path> all;
  const auto full = [](const fs::path& path) {
    const fs::path normal = fs::absolute(path).lexically_normal();
    return normal.has_filename() ? normal : normal.parent_path();
  };
  const fs::path end = full(top).parent_path();
  for (const fs::path& folder : folders_) {
    fs::path step = full(folder);
    while (all.insert(step).second && step != end && step.has_relative_path()) {
      step = step.parent_path();
    }
  }
  for (const fs::path& folder : all) sync_folder(folder);
}

}  // namespace reprise::cli
