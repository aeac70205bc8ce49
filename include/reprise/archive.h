// The archive: what most programs that use Reprise as a library need. Search, plots and synthetic
// takes have headers of their own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reprise/formats/motion_file.h"
#include "reprise/model/measure.h"
#include "reprise/model/take.h"

namespace reprise {

/// How faithful a stored take is. Persisted in archives: never change a value.
enum class FidelityTier : std::uint8_t {
  preview = 1,
  standard = 2,
  fine = 3,
  exact = 4,
  bound = 5
};

/// "preview", "standard", "fine", "exact", "bound".
std::string tier_name(FidelityTier tier);

/// What the tiers promise (docs/measures.md).
struct FidelityLimits {
  static constexpr double preview_mean_mm = 20.0;  ///< mean joint error of a take
  static constexpr double standard_mm = 10.0;      ///< every joint in every frame
  static constexpr double fine_mm = 1.0;           ///< the same
  static constexpr double standard_deg = 10.0;     ///< every joint's world orientation
  static constexpr double fine_deg = 1.0;          ///< the same
  static constexpr double least_bound_mm = 0.05, greatest_bound_mm = 100.0;
  static constexpr double least_bound_deg = 0.05, greatest_bound_deg = 180.0;
};

struct Fidelity {
  FidelityTier tier = FidelityTier::standard;
  /// preview: of the take's mean joint error; exact: 0; others: of every joint in every frame.
  double limit_mm = FidelityLimits::standard_mm;
  /// preview and exact: 0; others: of every joint's world orientation in every frame, and of how
  /// much more than the source's a joint turns against its parent from one frame to the next.
  double limit_deg = FidelityLimits::standard_deg;

  bool operator==(const Fidelity&) const = default;
};

/// A tier with its own limit; `bound` has none.
Fidelity fidelity_of(FidelityTier tier);

enum class ClipKind : std::uint8_t { primary = 1, repeated = 2, unique = 3 };
std::string clip_kind_name(ClipKind kind);

/// Content address of a clip: a digest of its skeleton's structure and the source's channel values
/// over its frames. 16 hexadecimal digits.
using ClipId = std::string;

struct TakeInfo {
  std::int64_t id = 0;  ///< row in this archive, not stable across archives
  std::string name;
  std::string subject;
  std::string description;
  std::string tags;
  MotionFormat format = MotionFormat::bvh;
  std::int64_t skeleton = 0;
  long frames = 0;
  double frame_rate = 0;
  bool frame_rate_assumed = false;
  double unit_mm = 0;         ///< millimetres a unit of length of its file
  bool unit_assumed = false;  ///< guessed from the body, or left at 10 mm
  UpAxis up = UpAxis::y;
  bool up_assumed = false;  ///< found from the motion, not given
  Fidelity fidelity;
  std::uint64_t raw_bytes = 0;   ///< 4 x channels x frames
  std::uint64_t text_bytes = 0;  ///< the source file
  std::uint64_t payload_bytes = 0;
  PositionErrors error_mm;      ///< as measured at ingest on the decoded take
  RotationErrors rotation_deg;  ///< the same
  JointAt worst_place, worst_turn;
  std::string source_digest;  ///< hexadecimal digest of the source file's bytes

  double seconds() const { return static_cast<double>(frames) / frame_rate; }
};

struct ClipInfo {
  ClipId id;
  std::string take;
  ClipKind kind = ClipKind::unique;
  std::int64_t group = 0;  ///< behaviour group; 0 where there are none
  long first_frame = 0;
  long frames = 0;
  double start = 0;  ///< seconds
  double end = 0;
  ClipId primary;  ///< of a repeated clip, else empty
  std::uint64_t bytes = 0;
};

struct SkeletonInfo {
  std::int64_t id = 0;
  MotionFormat format = MotionFormat::bvh;
  std::size_t joints = 0;  ///< with end sites
  std::size_t channels = 0;
  std::size_t takes = 0;
  std::size_t proportions = 0;  ///< how many sets of offsets and lengths (actors) share it
  std::string root;             ///< name of the first joint
};

struct TakeFilter {
  std::string take;     ///< name or trailing part of it; empty: all
  std::string subject;  ///< exact; empty: all
  std::string text;     ///< words that the description, tags, name or subject must hold
  std::optional<ClipKind> kind;
};

struct ArchiveStats {
  std::size_t takes = 0;
  std::uint64_t frames = 0;
  double seconds = 0;
  std::size_t subjects = 0;
  std::size_t skeletons = 0;
  std::size_t groups = 0;
  std::size_t primary_clips = 0;
  std::size_t repeated_clips = 0;
  std::size_t unique_clips = 0;
  std::uint64_t raw_bytes = 0;
  std::uint64_t text_bytes = 0;
  std::uint64_t archive_bytes = 0;
  std::uint64_t payload_bytes = 0;
  std::map<std::string, std::uint64_t> bytes;  ///< parts of archive_bytes; they add up
  PositionErrors error_mm;
  RotationErrors rotation_deg;
  std::string worst_place_take, worst_turn_take;  ///< the takes that the greatest errors are in
  std::map<std::string, std::size_t> fidelity;    ///< takes a tier
};

struct ArchiveInfo {
  std::string
      content_digest;  ///< hexadecimal; equal for equal content, however it was put together
  int format_version = 0;
  std::string written_by;
  ArchiveStats stats;
};

struct Damage {
  std::string id;  ///< take, clip or part of the archive, or a folder of sources
  std::string why;
  bool outside_fidelity = false;  ///< the archive is whole, but a take is further from its source
                                  ///< than promised, or its source is not at hand
};

struct VerifyReport {
  bool ok = true;  ///< nothing is in `damaged`
  std::size_t takes = 0;
  std::size_t clips = 0;
  std::vector<Damage> damaged;
  std::size_t measured = 0;  ///< takes that `error_mm` is of
  /// Measured against the sources where `against` was given, else as stored.
  PositionErrors error_mm;
  RotationErrors rotation_deg;
};

struct Progress {
  std::size_t done = 0;
  std::size_t total = 0;
  std::string current;   ///< the take or file at hand
  bool waiting = false;  ///< for other processes that read the archive; nothing was done since
};
/// Called from one thread at a time. Returning false asks to stop: the call ends with Error
/// (interrupted) after the batch at hand is complete or rolled back.
using ProgressSink = std::function<bool(const Progress&)>;

struct IngestOptions {
  std::vector<std::filesystem::path> paths;
  Fidelity fidelity;
  ReadOptions read;
  unsigned jobs = 1;                              ///< worker threads; results do not depend on it
  std::optional<std::filesystem::path> metadata;  ///< CSV: take, subject, description, tags
  std::string prefix;                             ///< put before the names of this ingest, with '/'
  bool replace = false;
  bool dry_run = false;
  bool contacts = true;  ///< feet are held where they stand
  bool repeats = true;   ///< false: each take is one unique clip without a behaviour group
  /// What coding takes may need at once, in bytes; 0: what the machine has free. A take that needs
  /// more by itself is rejected.
  std::size_t memory_bytes = 0;
};

struct RejectedInput {
  std::string path;
  std::size_t line = 0;
  std::string why;
  std::string advice = {};  ///< what to do about it
};

/// What was read otherwise than a file says, in a file that was taken in.
struct InputNote {
  std::string path;
  std::size_t line = 0;
  std::string what;
};

/// A take whose source is, byte for byte, that of another one.
struct SameSource {
  std::string name;
  std::string same_as;
};

/// What an ingest would do, from a sample of its takes that was coded for it.
struct IngestEstimate {
  std::uint64_t bytes = 0;  ///< that the archive would grow by
  double seconds = 0;
  std::size_t sampled = 0;  ///< takes
};

/// Takes whose unit was not given.
struct AssumedUnit {
  double unit_mm = 0;
  std::size_t takes = 0;
  /// Of the bodies that it was guessed from, in mm; 0 where there are none, so that it is only the
  /// most common unit.
  double least_height_mm = 0, greatest_height_mm = 0;
};

struct IngestReport {
  std::vector<std::string> added;       ///< stored by this ingest
  std::vector<std::string> replaced;    ///< of `added`: in place of a take of the same name
  std::vector<SameSource> same_source;  ///< of `added`: what is stored under another name, too
  std::vector<InputNote> notes;
  /// Files of folders that are no motion and no skeleton, by the ends of their names (".fbx", "" of
  /// none; ".bvh" where that is the whole name). Hidden ones are not counted.
  std::map<std::string, std::size_t> other_kinds;
  std::optional<IngestEstimate> estimate;  ///< of a dry run that would add something
  std::vector<std::string> skipped;
  std::vector<std::string>
      other_fidelity;  ///< of `skipped`: stored with another than was asked for
  std::vector<std::string> other_metadata;  ///< of `skipped`: not what their rows say
  /// Of `skipped`: stored with another unit or frame rate than was asked for.
  std::vector<std::string> other_reading;
  std::vector<RejectedInput> rejected;
  std::vector<AssumedUnit> assumed_units;  ///< of the BVH files of `added`, by unit
  /// Of `added`: ASF/AMC takes whose unit makes their body implausibly small or tall.
  std::vector<std::string> implausible_units;
  std::vector<std::string> takes_not_found;  ///< of the metadata: rows that are of no input
  double seconds = 0;
};

/// Adds takes. Inputs that cannot be taken in are reported, not thrown. Throws Error for what
/// concerns the archive or the machine. The archive is created with the first take that is stored.
IngestReport ingest(const std::filesystem::path& archive, const IngestOptions& options,
                    const ProgressSink& progress = {});

/// A frame range, half-open; `end` beyond the take is an error.
struct FrameRange {
  long begin = 0;
  long end = 0;
};

/// One place where a motion occurs.
struct MotionOccurrence {
  ClipId clip;  ///< the stored clip that holds the most of it
  std::string take;
  std::string subject;
  double start = 0;  ///< seconds
  double end = 0;
  double distance_mm = 0;  ///< mean joint distance to the group's first occurrence, along the best
                           ///< time alignment, with heading and ground place taken out
};

/// Places that repeat one motion: first the one that the others are held against.
struct RecurringMotion {
  std::string id;  ///< 16 hexadecimal digits; the same for the same reference
  std::vector<MotionOccurrence> occurrences;
};

struct RepeatQuery {
  std::optional<TakeInfo> take;      ///< only groups with an occurrence in this take
  std::optional<FrameRange> frames;  ///< only the repeats of these frames of `take`
  bool across_subjects = false;      ///< only groups with two subjects or more
  double least_seconds = 0;          ///< only occurrences at least this long
  unsigned jobs = 0;                 ///< worker threads, 0: one a core; results do not depend on it
};

/// An archive opened for reading; it never writes. Throws Error: damaged, newer_version, failed.
class Archive {
 public:
  explicit Archive(const std::filesystem::path& path);
  ~Archive();
  Archive(Archive&&) noexcept;
  Archive& operator=(Archive&&) noexcept;

  std::vector<TakeInfo> takes(const TakeFilter& filter = {}) const;
  /// All takes that a damaged archive still knows; what is lost of the others is added to
  /// `damaged`.
  std::vector<TakeInfo> readable_takes(std::vector<Damage>& damaged) const;
  std::vector<ClipInfo> clips(const TakeFilter& filter = {}) const;
  std::vector<SkeletonInfo> skeletons() const;
  std::vector<std::string> subjects() const;
  ArchiveStats stats() const;
  ArchiveInfo info() const;

  /// A take by name or unambiguous trailing part. Throws Error (not_found) with the candidates.
  TakeInfo find_take(const std::string& id) const;
  /// Clips by ID or unambiguous prefix of four digits or more: more than one where takes share
  /// content.
  std::vector<ClipInfo> find_clips(const std::string& id) const;

  /// What an ID names: a whole take, or the frames of a clip. Of a clip of several takes, in the
  /// one that is stored with the most fidelity, the first by name of equal ones.
  struct Selection {
    TakeInfo take;
    FrameRange frames;
    std::optional<ClipInfo> clip;
  };
  Selection find(const std::string& id) const;

  /// The decoded motion, of all that is stored or only as much as `tier` needs. Throws Error
  /// (damaged; usage where the take is stored with less than `tier`).
  Take extract(const TakeInfo& take, std::optional<FidelityTier> tier = std::nullopt) const;
  Take extract(const TakeInfo& take, FrameRange frames,
               std::optional<FidelityTier> tier = std::nullopt) const;
  /// The source file's bytes, of a take that is stored as `exact` (usage otherwise). An AMC's ASF
  /// is its skeleton's source_text.
  std::string source_text(const TakeInfo& take) const;
  /// A take's skeleton, without decoding its motion. Throws Error (damaged).
  std::shared_ptr<const Skeleton> skeleton(const TakeInfo& take) const;

  /// Where motion recurs, across the takes of each skeleton: groups of two occurrences or more,
  /// those that explain most first. Throws Error (damaged; usage where `frames` are not in the take
  /// or too few to be a motion).
  std::vector<RecurringMotion> repeats(const RepeatQuery& query = {},
                                       const ProgressSink& progress = {}) const;

  /// Reads and decodes everything; with `against`, measures each take against its source in that
  /// folder, in the length unit that it is stored with unless `read` says another, and holds it to
  /// its fidelity.
  VerifyReport verify(const std::optional<std::filesystem::path>& against = std::nullopt,
                      const ReadOptions& read = {}, const ProgressSink& progress = {}) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Takes out takes by their whole names, all or none. `progress` is called while other processes
/// keep it waiting. Throws Error (not_found, locked).
void remove_takes(const std::filesystem::path& archive, const std::vector<std::string>& names,
                  const ProgressSink& progress = {});

/// Gives back the space of removed takes. `progress` as above. Throws Error (locked).
void compact(const std::filesystem::path& archive, const ProgressSink& progress = {});

}  // namespace reprise
