#include "store/packed_columns.h"

#include <algorithm>
#include <cmath>

namespace reprise {
namespace {

void append_varint(Bytes& bytes, std::uint64_t value) {
  for (; value >= 128; value >>= 7) bytes.push_back(static_cast<std::uint8_t>(value | 128));
  bytes.push_back(static_cast<std::uint8_t>(value));
}

/// Reads on from `at`, which it moves; what is cut off is taken for zeros.
std::uint64_t read_varint(const Bytes& bytes, std::size_t& at) {
  std::uint64_t value = 0;
  for (int shift = 0; at < bytes.size() && shift < 63; shift += 7) {
    value |= std::uint64_t{bytes[at] & 127u} << shift;
    if ((bytes[at++] & 128) == 0) break;
  }
  return value;
}

}  // namespace

std::int64_t micrometres(double millimetres) { return std::llround(millimetres * 1000.0); }

const std::vector<std::string>& part_names() {
  static const std::vector<std::string> names = {"curves",      "repeats", "contacts",  "root",
                                                 "corrections", "text",    "refinement"};
  return names;
}

Bytes pack_layers(const LayerTable& table) {
  Bytes bytes;
  for (std::size_t i = 0; i < table.layers.size(); ++i) {
    const LayerRecord& layer = table.layers[i];
    bytes.push_back(static_cast<std::uint8_t>(static_cast<int>(layer.kind) << 4 | layer.base));
    append_varint(bytes, static_cast<std::uint64_t>(micrometres(layer.limit_mm)));
    bytes.insert(bytes.end(), table.digests[i].begin(), table.digests[i].end());
  }
  return bytes;
}

std::optional<LayerTable> unpack_layers(const Bytes& bytes) {
  LayerTable table;
  for (std::size_t at = 0; at < bytes.size();) {
    LayerRecord layer;
    layer.kind = static_cast<LayerKind>(bytes[at] >> 4);
    layer.base = bytes[at++] & 15;
    layer.limit_mm = static_cast<double>(read_varint(bytes, at)) / 1000.0;
    ShortDigest digest{};
    const bool known = layer.kind >= LayerKind::coefficients && layer.kind <= LayerKind::text;
    if (!known || static_cast<std::size_t>(layer.base) > table.layers.size() ||
        bytes.size() - std::min(at, bytes.size()) < digest.size()) {
      return std::nullopt;
    }
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), digest.size(), digest.begin());
    at += digest.size();
    table.layers.push_back(layer);
    table.digests.push_back(digest);
  }
  if (table.layers.empty() || table.layers.size() > most_layers) return std::nullopt;
  return table;
}

LayerTable layer_table(const std::vector<LayerRecord>& layers) {
  LayerTable table;
  for (const LayerRecord& layer : layers) {
    table.layers.push_back({layer.kind, layer.limit_mm, layer.base, {}});
    table.digests.push_back(shortened(digest_of(layer.data)));
  }
  return table;
}

Bytes pack_spent(const std::vector<std::pair<std::string, std::uint64_t>>& spent) {
  Bytes bytes;
  for (const auto& [name, size] : spent) {
    const auto part = std::ranges::find(part_names(), name);
    assert(part != part_names().end());
    bytes.push_back(static_cast<std::uint8_t>(part - part_names().begin()));
    append_varint(bytes, size);
  }
  return bytes;
}

std::vector<std::pair<std::string, std::uint64_t>> unpack_spent(const Bytes& bytes) {
  std::vector<std::pair<std::string, std::uint64_t>> spent;
  for (std::size_t i = 0; i < bytes.size();) {
    const std::size_t part = bytes[i++];
    const std::uint64_t size = read_varint(bytes, i);
    spent.emplace_back(part < part_names().size() ? part_names()[part] : "other", size);
  }
  return spent;
}

}  // namespace reprise
