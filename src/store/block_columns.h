// What packing a block of takes and unpacking it have in common.
#pragma once

#include <array>

#include "store/take_block.h"

namespace reprise {

/// Bytes of a layer in the data of its block; 0 where the take has no such layer.
inline std::uint64_t size_of_layer(const StoredTake& take, std::size_t layer) {
  return layer < take.places.size() ? take.places[layer].size : 0;
}

inline std::uint64_t size_of_layers(const StoredTake& take) {
  std::uint64_t sum = 0;
  for (const LayerPlace& place : take.places) sum += place.size;
  return sum;
}

/// The texts of a take, in the order in which blocks hold them.
template <class Info>
auto texts_of(Info& info) {
  return std::array{&info.name, &info.subject, &info.description, &info.tags};
}

}  // namespace reprise
