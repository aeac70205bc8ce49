// Reading and writing takes: BVH, and AMC with its ASF.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "reprise/model/take.h"

namespace reprise {

/// Limits on hostile or mistaken input; a file beyond one is rejected with the limit named
/// (docs/limits.md).
struct InputLimits {
  static constexpr std::size_t joints = 4096;
  static constexpr std::size_t channels = 16384;
  static constexpr std::size_t depth = 256;
  /// Channels of an AMC's skeleton for each number that a frame gives.
  static constexpr std::size_t channels_per_value = 16;
  static constexpr std::size_t name_bytes = 1024;
  static constexpr std::size_t number_bytes = 64;
  /// Of a number, in the file's units or degrees; far beyond it sums are no longer finite.
  static constexpr std::size_t magnitude = 1'000'000'000;
  static constexpr std::size_t line_bytes = 16u << 20;
  static constexpr std::size_t file_bytes = std::size_t{2} << 30;
};

/// What the files themselves do not say.
struct ReadOptions {
  /// Else 10, until it is guessed from the body (take_reading.h), or what a take is stored with.
  std::optional<double> bvh_millimetres_per_unit;
  std::optional<UpAxis> up;  ///< else Y, until it is found from the motion (take_reading.h)
  std::optional<double> amc_frame_rate;      ///< else 120 Hz, and the take says that it was assumed
  std::optional<std::filesystem::path> asf;  ///< else the skeleton beside the AMC (find_asf)
};

/// Parsers of text in memory. `file` names it in errors. Throw Error (rejected_input) with file and
/// line. The take's name is left empty. Frames that the file lacks are not invented: a BVH has the
/// frames that its lines hold; where `Frames:` disagrees the file is rejected. A frame rate that no
/// take may have (is_frame_rate) is an Error (usage).
Take read_bvh(std::string_view text, const std::string& file,
              double millimetres_per_unit = default_millimetres_per_unit);
Skeleton read_asf(std::string_view text, const std::string& file);
Take read_amc(std::string_view text, const std::string& file,
              std::shared_ptr<const Skeleton> skeleton,
              std::optional<double> frame_rate = std::nullopt);

/// The skeleton of a BVH text that ends where `MOTION` would stand (Skeleton::source_text).
Skeleton read_bvh_skeleton(std::string_view text, const std::string& file,
                           double millimetres_per_unit = default_millimetres_per_unit);

/// What a file's name says that it is: the extensions .bvh and .amc, in any case; else none.
std::optional<MotionFormat> motion_format_of(const std::filesystem::path& path);
bool is_motion_file(const std::filesystem::path& path);

/// Whether a file's name ends as those of ASF skeletons do, in any case.
bool is_skeleton_file(const std::filesystem::path& path);

/// The ASF of an AMC: its own name with .asf, else the file name up to the first '_' with .asf,
/// else the only ASF in its folder. Throws Error (rejected_input) that says what was looked for.
std::filesystem::path find_asf(const std::filesystem::path& amc);

/// Reads a file by its extension. Throws Error (rejected_input).
Take read_motion_file(const std::filesystem::path& path, const ReadOptions& options = {});

/// The whole content of a file. Throws Error (rejected_input) where it cannot be read or is beyond
/// the limit.
std::string read_whole_file(const std::filesystem::path& path);

/// The text of a take in its own format, with the header of its source (frame count as in the take)
/// and numbers with `decimals` digits after the point: else six, and more where the unit is so
/// large, or rotations are in radians, that six would move joints by more than 0.0001 mm or so.
std::string write_bvh(const Take& take, std::optional<int> decimals = std::nullopt);
std::string write_amc(const Take& take, std::optional<int> decimals = std::nullopt);
/// write_bvh or write_amc, by the skeleton's format.
std::string write_motion(const Take& take, std::optional<int> decimals = std::nullopt);

}  // namespace reprise
