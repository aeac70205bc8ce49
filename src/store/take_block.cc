#include "store/take_block.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "reprise/error.h"
#include "store/block_columns.h"

namespace reprise {
namespace {

/// Names of the parts of coded motion, in the order of their numbers. Never change one.
const std::vector<std::string>& part_names() {
  static const std::vector<std::string> names = {"curves",      "repeats", "contacts",  "root",
                                                 "corrections", "text",    "refinement"};
  return names;
}

}  // namespace

std::int64_t micrometres(double millimetres) { return std::llround(millimetres * 1000.0); }

std::uint64_t part_number(const std::string& name) {
  const auto part = std::ranges::find(part_names(), name);
  assert(part != part_names().end());
  return static_cast<std::uint64_t>(part - part_names().begin());
}

std::string part_name(std::uint64_t number) {
  if (number >= part_names().size()) {
    throw Error(ErrorCode::damaged, "the archive is damaged: a block of takes makes no sense");
  }
  return part_names()[number];
}

std::int64_t block_of(std::int64_t take) {
  return take / static_cast<std::int64_t>(TakeBlockLimits::takes);
}

const StoredTake* TakeBlock::find(std::int64_t take) const {
  const auto found = std::ranges::find_if(
      takes, [&](const StoredTake& candidate) { return id_of(candidate) == take; });
  return found == takes.end() ? nullptr : &*found;
}

std::int64_t TakeBlock::id_of(const StoredTake& take) const {
  return id * static_cast<std::int64_t>(TakeBlockLimits::takes) +
         static_cast<std::int64_t>(take.slot);
}

std::size_t TakeBlock::data_size() const {
  std::size_t size = 0;
  for (const StoredTake& take : takes) size += size_of_layers(take);
  return size;
}

ShortDigest block_digest(std::int64_t id, std::span<const std::uint8_t> bytes) {
  Hasher hasher;
  hasher.add_number(id);
  hasher.add_bytes(bytes);
  return shortened(hasher.finish());
}

}  // namespace reprise
