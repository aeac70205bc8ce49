// Which frames of which takes go into which files: decided and checked before anything is written.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/intervals.h"
#include "reprise/archive.h"

namespace reprise::cli {

/// What the arguments of extract ask for.
struct ExtractRequest {
  std::vector<std::string> ids;
  bool all = false;
  std::optional<Interval<long>> frames;
  std::optional<Interval<double>> time;
  std::optional<FidelityTier> fidelity;
  std::optional<MotionFormat> format;
};

struct PlannedExtract {
  std::string id;  ///< as asked for; the take's name with --all
  TakeInfo take;
  FrameRange frames;
  std::string file_name;  ///< name of the take or clip with its extension, '/' between folders
};

struct ExtractPlan {
  std::vector<PlannedExtract> entries;
  std::vector<Damage> damaged;    ///< with --all: what cannot be read of the archive
  std::vector<Damage> unwritten;  ///< with --all: takes that would have one file with another one
};

/// Throws Error: not_found, usage (fidelity or format that the archive cannot give), failed (frames
/// that are not there; of IDs that were named, two different motions with one file name). What is
/// asked for twice is planned once.
ExtractPlan plan_extract(const Archive& archive, const ExtractRequest& request);

/// "walk/01" and bvh: "walk/01.bvh"; a name that has the extension already keeps it.
std::string motion_file_name(std::string_view name, MotionFormat format);

}  // namespace reprise::cli
