// The one door to the archive file: typed records in, typed records out. Nothing outside this
// folder knows SQL, and nothing in it knows what is in a blob.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reprise/archive.h"

namespace reprise {

using Bytes = std::vector<std::uint8_t>;
using Digest = std::array<std::uint8_t, 16>;  ///< BLAKE2b-128
/// The first eight bytes of a digest, which is what rows carry.
using ShortDigest = std::array<std::uint8_t, 8>;

/// Whether a file that begins so is a Reprise archive, of any version.
bool begins_as_archive(std::string_view start);

/// Joints, hierarchy and channels that takes share (same_structure).
struct SkeletonRecord {
  std::int64_t id = 0;
  Digest structure{};  ///< digest of structure_bytes
  MotionFormat format = MotionFormat::bvh;
  std::size_t joints = 0;
  std::size_t channels = 0;
  std::string root;
};

/// What the files of takes say besides their numbers: one actor's offsets and lengths (the source
/// text of the skeleton), frame rate and headers. Takes share it where all of it is equal.
struct ProportionsRecord {
  std::int64_t id = 0;
  std::int64_t skeleton = 0;
  Digest identity{};  ///< of everything below; filled in by the store
  double millimetres_per_unit = 10;
  UpAxis up = UpAxis::y;
  double frame_rate = 0;
  bool frame_rate_assumed = false;
  bool unit_assumed = false;
  bool up_assumed = false;
  std::string asf_name;
  Bytes layout;  ///< opaque here
  std::string source_text;
};

/// A coefficient space: axes and what else the coder needs before a take can be decoded.
struct SpaceRecord {
  std::int64_t id = 0;
  std::int64_t skeleton = 0;
  std::int64_t base = 0;  ///< the space that this one extends, or 0
  Bytes data;
};

/// A space with all that it extends.
struct SpaceChain {
  std::vector<SpaceRecord> spaces;  ///< at least one
  Digest digest{};                  ///< of the last one
};

/// What a layer of a take holds. Persisted: never change a value.
enum class LayerKind : std::uint8_t {
  coefficients = 1,  ///< the take on the axes of its space; its mean error is bounded
  refinement = 2,    ///< angles that keep every joint of every frame within a bound
  text = 3,          ///< the source file byte for byte
  channels = 4       ///< angles as in a refinement; the take's mean error is bounded
};

/// One part of a coded take. Layers stand from the coarsest to the finest, and each is read alone.
struct LayerRecord {
  LayerKind kind = LayerKind::coefficients;
  double limit_mm = 0;   ///< what the layer promises, to a micrometre; 0 of a text
  double limit_deg = 0;  ///< the same, to a thousandth of a degree; 0 where it promises none
  Bytes data;            ///< opaque here
  ShortDigest digest{};  ///< of the data; filled in by the store
};

struct TakeRecord {
  TakeInfo
      info;  ///< id, skeleton, format, rates and raw and payload bytes are filled in by the store
  std::int64_t proportions = 0;
  std::int64_t space = 0;
  Bytes error_quantiles;            ///< sketch of the distances, opaque here
  Bytes turn_quantiles;             ///< the same of the turns
  std::vector<LayerRecord> layers;  ///< at least one, at most `most_layers`
  /// Bytes of the layers by what they are spent on; they add up to all of them.
  std::vector<std::pair<std::string, std::uint64_t>> spent;
};

/// Where a clip is: the n-th of a take. Take 0 is the take of the clip that refers there.
struct ClipPlace {
  std::int64_t take = 0;
  std::size_t index = 0;

  friend auto operator<=>(const ClipPlace&, const ClipPlace&) = default;
};

/// A clip of a take (what ClipInfo says, with rows for names). The clips of a take follow one
/// another and cover it.
struct ClipRecord {
  std::uint64_t id = 0;   ///< content address
  std::int64_t take = 0;  ///< filled in by the store
  ClipKind kind = ClipKind::unique;
  std::int64_t group = 0;
  long first_frame = 0;
  long frames = 0;
  ClipPlace primary_place;    ///< of a repeated clip
  std::uint64_t primary = 0;  ///< content address of the primary, or 0; filled in by the store
  std::uint64_t bytes = 0;    ///< its frames' share of the take's layers; filled in by the store
};

constexpr std::size_t most_layers = 8;

/// Called every second while a change is kept waiting by processes that read the archive. False
/// gives up: Error (interrupted).
using WaitNotice = std::function<bool()>;

struct StoredClip;

class ArchiveStore {
 public:
  struct Impl;

  /// Throws Error: failed (cannot be opened), damaged (or a folder), newer_version. Never writes,
  /// but for rolling back a transaction that a dead writer left.
  static ArchiveStore open_for_reading(const std::filesystem::path& path);
  /// Where there is no file, one without takes is put there whole; it is taken away again if
  /// nothing was committed. Throws Error (locked) at once if another process holds it for writing.
  static ArchiveStore open_for_writing(const std::filesystem::path& path, WaitNotice waiting = {});
  ~ArchiveStore();
  ArchiveStore(ArchiveStore&&) noexcept;
  ArchiveStore& operator=(ArchiveStore&&) noexcept;

  // Writing: everything between begin() and commit() is stored together or not at all. Each throws
  // Error (limit where the disk is full, failed, damaged). A store whose commit failed takes no
  // more writes.
  void begin();
  void commit();
  void roll_back();
  std::int64_t add_skeleton(const SkeletonRecord& record);
  std::int64_t add_proportions(const ProportionsRecord& record);
  /// They stay, with their skeleton and its spaces, for as long as this store is open, though no
  /// take needs them yet, or any more.
  void hold_proportions(std::int64_t id);
  std::int64_t add_space(const SpaceRecord& record);
  std::int64_t add_take(const TakeRecord& take, std::span<const ClipRecord> clips);
  /// Other kinds, groups and primaries for the clips of stored takes. Which frames they have, and
  /// their IDs, stay as they are. A repeated clip refers to a primary one.
  void set_clips(const std::map<std::int64_t, std::vector<ClipRecord>>& clips);
  /// With its clips; what nothing refers to any more goes with it. Clips that repeat one of them
  /// become unique, and so do primaries that nothing repeats any more.
  void remove_take(std::int64_t id);
  void compact();  ///< outside a transaction

  struct EndSnapshot {
    void operator()(Impl* impl) const;
  };
  /// While one lives, every answer is of one state of the archive. A writer's commit waits for it
  /// to end, so none should live for long.
  using Snapshot = std::unique_ptr<Impl, EndSnapshot>;
  /// Within another, or within a transaction, it is a part of that. Throws Error (locked, damaged).
  [[nodiscard]] Snapshot snapshot() const;
  /// Changes when another process has committed.
  std::int64_t state_number() const;

  // Reading. Every row that is returned has passed its digest; one that has not throws Error
  // (damaged).
  std::optional<SkeletonRecord> find_skeleton(const Digest& structure) const;
  /// The stored one that is equal to this one, whatever its id.
  std::optional<std::int64_t> find_proportions(const ProportionsRecord& record) const;
  SkeletonRecord skeleton(std::int64_t id) const;
  ProportionsRecord proportions(std::int64_t id) const;
  /// The first proportions of a skeleton: those that its spaces are made for. They stay while it
  /// stays.
  ProportionsRecord reference_proportions(std::int64_t skeleton) const;
  /// Ids of all proportions of a skeleton, ascending.
  std::vector<std::int64_t> proportions_of_skeleton(std::int64_t skeleton) const;
  SpaceRecord space(std::int64_t id) const;
  /// The spaces that a space extends, the first one first, then itself; all of one skeleton.
  SpaceChain space_chain(std::int64_t id) const;
  std::vector<std::int64_t> spaces_of_skeleton(
      std::int64_t skeleton) const;  ///< in order of creation
  /// These two leave the data of the layers out.
  std::optional<TakeRecord> find_take(const std::string& name) const;
  TakeRecord take(std::int64_t id) const;
  Bytes layer(std::int64_t take, std::size_t index) const;
  std::vector<std::string> take_names_ending_in(const std::string& tail, std::size_t most) const;
  std::vector<TakeInfo> takes(const TakeFilter& filter) const;  ///< by name
  std::vector<ClipRecord> clips(
      std::span<const std::int64_t> takes) const;  ///< by take name, first frame
  /// Those that can be read, by name; what cannot be read of the others is added to `damaged`.
  std::vector<TakeInfo> readable_takes(std::vector<Damage>& damaged) const;
  /// Every take without the data of its layers, in the order of their rows.
  void for_each_take(const std::function<void(const TakeRecord&)>& visit) const;
  std::vector<ClipRecord> clips_with_prefix(const std::string& hexadecimal) const;
  std::vector<SkeletonInfo> skeletons() const;
  std::vector<std::string> subjects() const;
  /// All but the 99th percentiles of errors, which need the sketches: takes are handed to `sketch`
  /// with the number of distances (joints x frames) that each of theirs stands for.
  ArchiveStats stats(const std::function<void(const TakeRecord&, std::uint64_t)>& sketch) const;
  /// What a take is, wherever it stands: the digest of everything that is stored of it.
  Digest content_of(std::int64_t take) const;
  Digest digest_of_space(std::int64_t id) const;
  Digest content_digest() const;  ///< independent of the order in which takes were added
  std::string written_by() const;
  int format_version() const;

  /// Reads every page and every row; returns what is wrong, in words. Blobs are checked against
  /// their digests but not decoded.
  std::vector<Damage> check_structure() const;

 private:
  /// Takes whose name is `tail` or, unless `whole`, ends in it after a slash.
  std::vector<TakeRecord> takes_named(const std::string& tail, bool whole) const;
  /// Takes of the blocks that have all of these terms (terms.h).
  void for_each_take_with(const std::set<std::int64_t>& terms,
                          const std::function<void(const TakeRecord&)>& visit) const;
  void count_clips(ArchiveStats& stats) const;
  void change_clips(const std::map<std::int64_t, std::vector<ClipRecord>>& changes);
  /// Makes clips of other takes unique where they repeat clips of this one, or are repeated by
  /// nothing else.
  void unlink_take(std::int64_t id);
  /// A clip's primary. Throws Error (damaged) where there is none.
  StoredClip primary_of(const ClipRecord& clip) const;
  void count_bytes(ArchiveStats& stats, std::uint64_t motion) const;
  void check_takes(std::vector<Damage>& damaged) const;
  bool has_clip_of_kind(std::int64_t take, ClipKind kind) const;

  explicit ArchiveStore(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace reprise
