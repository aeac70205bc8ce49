// Keys that lead to takes or to blocks of them, many in each row of `keys` (docs/format.md).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "store/database.h"

namespace reprise {

/// Keys have at most this many bits.
constexpr int key_bits = 24;
/// Ids that keys can lead to have at most this many.
constexpr int key_target_bits = 39;

/// What keys lead to. Each has keys, and rows, of its own.
enum class KeyTarget { take, block };

class KeyRows {
 public:
  KeyRows(const Database& database, KeyTarget target);

  /// A key may lead to many ids. What is there already, or is not there, changes nothing.
  void add(std::int64_t key, std::int64_t id) const;
  void remove(std::int64_t key, std::int64_t id) const;

  // These throw Error (damaged) for rows that add and remove do not write.
  /// Ids that one of the keys from `first` to `last` leads to, ascending, each once.
  std::vector<std::int64_t> find(std::int64_t first, std::int64_t last) const;
  std::size_t count() const;  ///< pairs of a key and an id in all rows

 private:
  /// A key and an id as one number: numbers go by key first.
  using Pair = std::int64_t;

  /// The row that holds a pair or would: the last that begins at or before it, else the first of
  /// all.
  std::vector<Pair> row_for(Pair pair) const;
  std::vector<Pair> next_row(Statement& rows) const;
  void write_row(std::span<const Pair> pairs) const;
  /// As one row or, where they are too many, as two.
  void write_rows(std::span<const Pair> pairs) const;
  void delete_row(Pair first) const;

  const Database& database_;
  /// Rows have the id first_row_ + the least of their pairs.
  std::int64_t first_row_, last_row_;
};

}  // namespace reprise
