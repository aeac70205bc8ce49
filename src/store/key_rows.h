// Keys that lead to takes, many in each row of `keys` (docs/format.md).
#pragma once

#include <cstdint>
#include <vector>

#include "store/database.h"

namespace reprise {

/// Keys have this many bits.
constexpr int key_bits = 24;
/// Ids of takes that keys can lead to have at most this many.
constexpr int key_take_bits = 39;

class KeyRows {
 public:
  explicit KeyRows(const Database& database) : database_(database) {}

  /// A key may lead to many takes. What is there already, or is not there, changes nothing.
  void add(std::int64_t key, std::int64_t take) const;
  void remove(std::int64_t key, std::int64_t take) const;

  // These throw Error (damaged) for rows that add and remove do not write.
  /// Takes that one of the keys from `first` to `last` leads to, ascending, each once.
  std::vector<std::int64_t> takes(std::int64_t first, std::int64_t last) const;
  std::size_t count() const;  ///< pairs of a key and a take in all rows

 private:
  const Database& database_;
};

}  // namespace reprise
