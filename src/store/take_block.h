// A block of takes: what is known of up to 64 of them, in the bytes of one row (docs/format.md).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "store/archive_store.h"
#include "store/digest.h"

namespace reprise {

struct TakeBlockLimits {
  static constexpr std::size_t takes = 64;
  /// A block of so many bytes of coded motion takes no further take: what is damaged together, and
  /// rewritten when a take is added, stays small.
  static constexpr std::size_t open_bytes = 1u << 17;
  static constexpr std::size_t parts = 16;      ///< of `spent`
  static constexpr std::size_t quantiles = 64;  ///< bytes of a sketch
};

/// Where a layer's bytes are in the data of its block.
struct LayerPlace {
  std::size_t offset = 0;
  std::size_t size = 0;
  bool compressed = false;  ///< a zstd frame, else the layer as it is
  ShortDigest digest{};     ///< of the layer
};

/// A clip of a take; it begins where the one before it ends.
struct StoredClip {
  std::uint64_t address = 0;
  ClipKind kind = ClipKind::unique;
  std::int64_t group = 0;
  long frames = 0;
  ClipPlace primary;  ///< of a repeated clip; its take is never 0

  friend bool operator==(const StoredClip&, const StoredClip&) = default;
};

struct StoredTake {
  std::size_t slot = 0;  ///< take = 64 x block + slot
  /// Without what the rows of proportions and skeleton say, and without the data of layers.
  TakeRecord record;
  std::vector<LayerPlace> places;  ///< one a layer
  std::vector<StoredClip> clips;
};

struct TakeBlock {
  std::int64_t id = 0;
  std::vector<StoredTake> takes;  ///< by slot

  const StoredTake* find(std::int64_t take) const;
  std::int64_t id_of(const StoredTake& take) const;
  std::size_t data_size() const;
};

std::int64_t block_of(std::int64_t take);

Bytes pack_block(const TakeBlock& block);
/// Throws Error (damaged) for anything that pack_block did not write.
TakeBlock unpack_block(std::int64_t id, std::span<const std::uint8_t> bytes);
/// Of a block's bytes, and of where it stands.
ShortDigest block_digest(std::int64_t id, std::span<const std::uint8_t> bytes);

/// Errors and limits are stored in whole thousandths: micrometres, and thousandths of a degree.
std::int64_t micrometres(double millimetres);

/// The number that stands for a part of coded motion ("curves", ...). Parts are a closed list.
std::uint64_t part_number(const std::string& name);
std::string part_name(std::uint64_t number);

}  // namespace reprise
