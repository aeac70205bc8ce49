// Columns of whole numbers in as many bits as they need (docs/format.md).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "store/archive_store.h"

namespace reprise {

/// Signed numbers as unsigned ones: 0, -1, 1, -2, 2 ... are 0, 1, 2, 3, 4 ...
std::uint64_t folded(std::int64_t value);
std::int64_t unfolded(std::uint64_t value);

class ColumnWriter {
 public:
  /// The least number, the bits of the largest difference from it, and the differences. Nothing at
  /// all where there are no numbers.
  void numbers(std::span<const std::uint64_t> values);
  void number(std::uint64_t value);  ///< as a base-128 varint
  void raw(std::span<const std::uint8_t> bytes);
  Bytes finish() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

/// Reads what a ColumnWriter wrote; throws Error (damaged) where that ends too early.
class ColumnReader {
 public:
  explicit ColumnReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  std::vector<std::uint64_t> numbers(std::size_t count);
  std::uint64_t number();
  std::span<const std::uint8_t> raw(std::size_t size);
  std::span<const std::uint8_t> rest() { return raw(left()); }
  std::size_t left() const { return bytes_.size() - at_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

}  // namespace reprise
