// Columns of a take's row that hold several values in a few bytes (docs/format.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "store/archive_store.h"
#include "store/digest.h"

namespace reprise {

/// Errors and limits are stored in whole micrometres.
std::int64_t micrometres(double millimetres);

/// Names of the parts of coded motion, in the order of their numbers in takes.spent. Never change
/// one.
const std::vector<std::string>& part_names();
/// The layers of a take as its row tells of them: of each kind, base, limit and short digest of the
/// data.
struct LayerTable {
  std::vector<LayerRecord> layers;  ///< without data
  std::vector<ShortDigest> digests;
};
Bytes pack_layers(const LayerTable& table);
std::optional<LayerTable> unpack_layers(const Bytes& bytes);  ///< nothing: not such a table
LayerTable layer_table(const std::vector<LayerRecord>& layers);

Bytes pack_spent(const std::vector<std::pair<std::string, std::uint64_t>>& spent);
std::vector<std::pair<std::string, std::uint64_t>> unpack_spent(const Bytes& bytes);

}  // namespace reprise
