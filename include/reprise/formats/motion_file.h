// Reading and writing takes: BVH, and AMC with its ASF.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
  /// Before what a file says; else that, and of an AMC that says nothing 120 Hz, recorded as
  /// assumed.
  std::optional<double> frame_rate;
  /// Skeletons of AMC files: the only one, or the one that choose_asf takes; else those beside each
  /// (find_asf).
  std::vector<std::filesystem::path> asf;
  bool partial = false;  ///< a recording that was cut off is taken as far as it goes
};

/// Parsers of text in memory. `file` names it in errors. Throw Error (rejected_input) with file and
/// line. The take's name is left empty. Frames that the file lacks are not invented: a BVH has the
/// frames that its lines hold. More of them than `Frames:` says are a note of the take. Fewer, or a
/// last frame that is cut, are a recording that was cut off: it is rejected, or with `partial`
/// taken as far as it goes, which is a note, too. `frame_rate` comes before what the file says,
/// whatever that is; one that no take may have (is_frame_rate) is an Error (usage).
Take read_bvh(std::string_view text, const std::string& file,
              double millimetres_per_unit = default_millimetres_per_unit,
              std::optional<double> frame_rate = std::nullopt, bool partial = false);
/// With `all_turns` each bone that has degrees of freedom has the turns that it lacks, too: behind
/// its own, about x, y and z in this order, as AMC files with `:FORCE-ALL-JOINTS-BE-3DOF` have
/// them.
Skeleton read_asf(std::string_view text, const std::string& file, bool all_turns = false);
/// The take's skeleton is `skeleton`, or with all turns where the file says so.
Take read_amc(std::string_view text, const std::string& file,
              std::shared_ptr<const Skeleton> skeleton,
              std::optional<double> frame_rate = std::nullopt, bool partial = false);
/// Whether the lines before an AMC's first frame say that every bone has all turns.
bool amc_has_all_turns(std::string_view header);

/// The skeleton of a BVH text that ends where `MOTION` would stand (Skeleton::source_text).
Skeleton read_bvh_skeleton(std::string_view text, const std::string& file,
                           double millimetres_per_unit = default_millimetres_per_unit);

/// The end of the names of a format's files, with the point: ".bvh" or ".amc".
std::string_view file_ending(MotionFormat format);
/// What a file's name says that it is: the extensions .bvh and .amc, in any case, also where that
/// is the whole name; else none.
std::optional<MotionFormat> motion_format_of(const std::filesystem::path& path);
bool is_motion_file(const std::filesystem::path& path);
/// Whether a name begins with "._": what a Mac puts beside a file on a foreign disk; it holds no
/// motion.
bool is_resource_fork(const std::filesystem::path& path);

/// Whether a file's name ends as those of ASF skeletons do, in any case.
bool is_skeleton_file(const std::filesystem::path& path);

/// The ASF of an AMC among some: the one whose name the AMC's begins with, up to an end of a word
/// or a number (`HDM_mm.asf` of `HDM_mm_walk_120.amc`), the longest of several; else the one whose
/// words all stand in the AMC's name in their order, from the first one on (`07-walk.asf` of
/// `07_05-walk.amc`). Upper and lower case do not matter. None where no name fits; where two fit
/// equally well throws Error (rejected_input) that names them.
std::optional<std::filesystem::path> choose_asf(
    const std::filesystem::path& amc, const std::vector<std::filesystem::path>& skeletons);

/// The same among those in the AMC's folder, else the only one there. Throws Error (rejected_input)
/// that says what was looked for.
std::filesystem::path find_asf(const std::filesystem::path& amc);

/// The ASF that `options` names for this AMC, or the one beside it. Throws Error (rejected_input).
std::filesystem::path asf_of(const std::filesystem::path& amc, const ReadOptions& options);

/// The skeleton of an ASF file, with its name. Throws Error (rejected_input).
Skeleton read_asf_file(const std::filesystem::path& path);

/// Reads a file by its extension. Throws Error (rejected_input).
Take read_motion_file(const std::filesystem::path& path, const ReadOptions& options = {});

/// The whole content of a file. Throws Error (rejected_input) where it cannot be read or is beyond
/// the limit.
std::string read_whole_file(const std::filesystem::path& path);
/// The same of a stream that `name` stands for in errors; what is beyond the limit is not read.
std::string read_stream(std::istream& stream, const std::string& name);

/// The text of a take in its own format, with the header of its source (frame count as in the take)
/// and numbers with `decimals` digits after the point: else six, and more where the unit is so
/// large, or rotations are in radians, that six would move joints by more than 0.0001 mm or so.
std::string write_bvh(const Take& take, std::optional<int> decimals = std::nullopt);
std::string write_amc(const Take& take, std::optional<int> decimals = std::nullopt);
/// write_bvh or write_amc, by the skeleton's format.
std::string write_motion(const Take& take, std::optional<int> decimals = std::nullopt);

}  // namespace reprise
