// What unpacking a block of takes reads: columns of numbers, one or several a take. Nothing in them
// is believed.
#pragma once

#include <algorithm>
#include <vector>

#include "store/number_columns.h"
#include "store/take_block.h"

namespace reprise {

constexpr std::int64_t most_id = std::int64_t{1} << 62;
constexpr std::uint64_t most_frames = std::uint64_t{1} << 40;

/// Error (damaged).
[[noreturn]] void throw_damaged_block();

/// A number that must be below a bound, to be used as one of another type.
template <class Number>
Number checked(std::uint64_t value, std::uint64_t most) {
  if (value > most) throw_damaged_block();
  return static_cast<Number>(value);
}

/// The next columns of a reader, put into takes.
class TakeColumns {
 public:
  TakeColumns(std::vector<StoredTake>& takes, ColumnReader& reader)
      : takes_(takes), reader_(reader) {}

  /// One number a take: put(take, number).
  template <class Put>
  void column(const Put& put) {
    const std::vector<std::uint64_t> values = reader_.numbers(takes_.size());
    for (std::size_t i = 0; i < values.size(); ++i) put(takes_[i], values[i]);
  }
  /// How many numbers each take has of something that it has at most `most` of.
  template <class Resize>
  void counts(std::size_t most, const Resize& resize) {
    column([&](StoredTake& take, std::uint64_t count) {
      if (count > most) throw_damaged_block();
      resize(take, static_cast<std::size_t>(count));
    });
  }
  /// As many numbers a take as count(take) says: put(take, index, number).
  template <class Count, class Put>
  void columns(const Count& count, const Put& put) {
    std::size_t all = 0;
    for (const StoredTake& take : takes_) all += count(take);
    const std::vector<std::uint64_t> values = reader_.numbers(all);
    std::size_t next = 0;
    for (StoredTake& take : takes_) {
      const std::size_t own = count(take);
      for (std::size_t i = 0; i < own; ++i) put(take, i, values[next++]);
    }
  }

  /// The same, with a column for each index, of the takes that have so many.
  template <class Count, class Put>
  void columns_by_place(const Count& count, const Put& put) {
    std::size_t most = 0;
    for (const StoredTake& take : takes_) most = std::max(most, count(take));
    for (std::size_t place = 0; place < most; ++place) {
      columns([&](const StoredTake& t) -> std::size_t { return place < count(t) ? 1 : 0; },
              [&](StoredTake& t, std::size_t, std::uint64_t v) { put(t, place, v); });
    }
  }

 private:
  std::vector<StoredTake>& takes_;
  ColumnReader& reader_;
};

}  // namespace reprise
