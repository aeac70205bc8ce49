#include "store/key_rows.h"

#include <algorithm>
#include <cassert>
#include <span>

#include "store/number_columns.h"

namespace reprise {
namespace {

/// So many of the rows fit a page that little of it stays empty.
constexpr std::size_t most_pairs = 64;

/// A key and a take as one number: numbers go by key first. The id of a row is its least.
using Pair = std::int64_t;
constexpr std::int64_t take_limit = std::int64_t{1} << key_take_bits;

Pair pair_of(std::int64_t key, std::int64_t take) {
  assert(key >= 0 && key < std::int64_t{1} << key_bits && take >= 0 && take < take_limit);
  return key << key_take_bits | take;
}
std::int64_t key_of(Pair pair) { return pair >> key_take_bits; }
std::int64_t take_of(Pair pair) { return pair & (take_limit - 1); }

[[noreturn]] void throw_damaged() {
  throw Error(ErrorCode::damaged, "the archive is damaged: a row of keys is not as it was written");
}

/// What follows the first pair: differences of keys, and takes.
Bytes pack(std::span<const Pair> pairs) {
  std::vector<std::uint64_t> steps, takes;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    steps.push_back(static_cast<std::uint64_t>(key_of(pairs[i]) - key_of(pairs[i - 1])));
    takes.push_back(static_cast<std::uint64_t>(take_of(pairs[i])));
  }
  ColumnWriter writer;
  writer.number(steps.size());
  writer.numbers(steps);
  writer.numbers(takes);
  return writer.finish();
}

std::vector<Pair> unpack(Pair first, std::span<const std::uint8_t> bytes) {
  ColumnReader reader(bytes);
  const std::uint64_t more = reader.number();
  if (first < 0 || more >= most_pairs) throw_damaged();
  const std::vector<std::uint64_t> steps = reader.numbers(more), takes = reader.numbers(more);
  std::vector<Pair> pairs = {first};
  for (std::size_t i = 0; i < more; ++i) {
    const auto key_left =
        (std::uint64_t{1} << key_bits) - 1 - static_cast<std::uint64_t>(key_of(pairs.back()));
    if (steps[i] > key_left || takes[i] >= static_cast<std::uint64_t>(take_limit)) throw_damaged();
    const Pair next = pair_of(key_of(pairs.back()) + static_cast<std::int64_t>(steps[i]),
                              static_cast<std::int64_t>(takes[i]));
    if (next <= pairs.back()) throw_damaged();
    pairs.push_back(next);
  }
  if (reader.left() != 0) throw_damaged();
  return pairs;
}

std::vector<Pair> next_row(Statement& rows) {
  const Pair first = rows.integer();
  return unpack(first, rows.bytes());
}

/// The row that holds a pair or would: the last that begins at or before it, else the first of all.
std::vector<Pair> row_for(const Database& database, Pair pair) {
  Statement before(database, "SELECT id, more FROM keys WHERE id<=? ORDER BY id DESC LIMIT 1");
  before.bind(pair);
  if (before.step()) return next_row(before);
  Statement after(database, "SELECT id, more FROM keys WHERE id>? ORDER BY id LIMIT 1");
  after.bind(pair);
  return after.step() ? next_row(after) : std::vector<Pair>();
}

void write_row(const Database& database, std::span<const Pair> pairs) {
  Statement(database, "INSERT INTO keys(id, more) VALUES(?,?)")
      .bind(pairs.front())
      .bind(pack(pairs))
      .run();
}

void delete_row(const Database& database, Pair first) {
  Statement(database, "DELETE FROM keys WHERE id=?").bind(first).run();
}

/// As one row or, where they are too many, as two.
void write_rows(const Database& database, std::span<const Pair> pairs) {
  if (pairs.size() > most_pairs) {
    write_row(database, pairs.first(pairs.size() / 2));
    pairs = pairs.subspan(pairs.size() / 2);
  }
  if (!pairs.empty()) write_row(database, pairs);
}

}  // namespace

void KeyRows::add(std::int64_t key, std::int64_t take) const {
  const Pair pair = pair_of(key, take);
  std::vector<Pair> pairs = row_for(database_, pair);
  if (std::ranges::binary_search(pairs, pair)) return;
  if (!pairs.empty()) delete_row(database_, pairs.front());
  pairs.insert(std::ranges::lower_bound(pairs, pair), pair);
  write_rows(database_, pairs);
}

void KeyRows::remove(std::int64_t key, std::int64_t take) const {
  const Pair pair = pair_of(key, take);
  std::vector<Pair> pairs = row_for(database_, pair);
  const auto at = std::ranges::lower_bound(pairs, pair);
  if (at == pairs.end() || *at != pair) return;
  delete_row(database_, pairs.front());
  pairs.erase(at);
  write_rows(database_, pairs);
}

std::vector<std::int64_t> KeyRows::takes(std::int64_t first, std::int64_t last) const {
  const Pair from = pair_of(first, 0), to = pair_of(last, take_limit - 1);
  std::vector<std::int64_t> takes;
  const auto collect = [&](const std::vector<Pair>& pairs) {
    for (const Pair pair : pairs) {
      if (pair >= from && pair <= to) takes.push_back(take_of(pair));
    }
  };
  collect(row_for(database_, from));
  Statement rows(database_, "SELECT id, more FROM keys WHERE id>? AND id<=?");
  rows.bind(from).bind(to);
  while (rows.step()) collect(next_row(rows));
  std::ranges::sort(takes);
  takes.erase(std::ranges::unique(takes).begin(), takes.end());
  return takes;
}

std::size_t KeyRows::count() const {
  std::size_t count = 0;
  Pair last = -1;
  Statement rows(database_, "SELECT id, more FROM keys ORDER BY id");
  while (rows.step()) {
    const std::vector<Pair> pairs = next_row(rows);
    if (pairs.front() <= last) throw_damaged();
    last = pairs.back();
    count += pairs.size();
  }
  return count;
}

}  // namespace reprise
