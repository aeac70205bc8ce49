// A deterministic library of synthetic takes with known repeated motions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "reprise/model/take.h"

namespace reprise {

struct SynthOptions {
  std::size_t takes = 24;
  double seconds = 12;  ///< mean length of a take
  std::size_t subjects = 4;
  std::uint64_t seed = 1;
  MotionFormat format = MotionFormat::bvh;
};

/// One place where a motion occurs. `speed` is relative to the first of its group, `noise` the RMS
/// of the noise in degrees a joint.
struct SynthOccurrence {
  std::string file;  ///< take name
  double start_s = 0;
  double end_s = 0;
  double speed = 1;
  double noise = 0;
};

struct SynthLibrary {
  std::vector<Take> takes;
  std::vector<std::vector<SynthOccurrence>> truth;  ///< one entry a motion, its occurrences
};

SynthLibrary make_synthetic_library(const SynthOptions& options);

/// Writes the takes (and ASF files) in one folder a subject, and truth.json; returns the number of
/// files. Existing files are replaced only with `overwrite`. Throws Error (failed).
std::size_t write_synthetic_library(const std::filesystem::path& folder,
                                    const SynthOptions& options, bool overwrite);

}  // namespace reprise
