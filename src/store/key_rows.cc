#include "store/key_rows.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "store/number_columns.h"

namespace reprise {
namespace {

/// So many of the rows fit a page that little of it stays empty.
constexpr std::size_t most_pairs = 64;

using Pair = std::int64_t;
constexpr std::int64_t id_limit = std::int64_t{1} << key_target_bits;

Pair pair_of(std::int64_t key, std::int64_t id) {
  assert(key >= 0 && key < std::int64_t{1} << key_bits && id >= 0 && id < id_limit);
  return key << key_target_bits | id;
}
std::int64_t key_of(Pair pair) { return pair >> key_target_bits; }
std::int64_t id_of(Pair pair) { return pair & (id_limit - 1); }

[[noreturn]] void throw_damaged() {
  throw Error(ErrorCode::damaged, "the archive is damaged: a row of keys is not as it was written");
}

/// What follows the first pair: differences of keys, and ids.
Bytes pack(std::span<const Pair> pairs) {
  std::vector<std::uint64_t> steps, ids;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    steps.push_back(static_cast<std::uint64_t>(key_of(pairs[i]) - key_of(pairs[i - 1])));
    ids.push_back(static_cast<std::uint64_t>(id_of(pairs[i])));
  }
  ColumnWriter writer;
  writer.number(steps.size());
  writer.numbers(steps);
  writer.numbers(ids);
  return writer.finish();
}

std::vector<Pair> unpack(Pair first, std::span<const std::uint8_t> bytes) {
  ColumnReader reader(bytes);
  const std::uint64_t more = reader.number();
  if (more >= most_pairs) throw_damaged();
  const std::vector<std::uint64_t> steps = reader.numbers(more), ids = reader.numbers(more);
  std::vector<Pair> pairs = {first};
  for (std::size_t i = 0; i < more; ++i) {
    const auto key_left =
        (std::uint64_t{1} << key_bits) - 1 - static_cast<std::uint64_t>(key_of(pairs.back()));
    if (steps[i] > key_left || ids[i] >= static_cast<std::uint64_t>(id_limit)) throw_damaged();
    const Pair next = pair_of(key_of(pairs.back()) + static_cast<std::int64_t>(steps[i]),
                              static_cast<std::int64_t>(ids[i]));
    if (next <= pairs.back()) throw_damaged();
    pairs.push_back(next);
  }
  if (reader.left() != 0) throw_damaged();
  return pairs;
}

}  // namespace

KeyRows::KeyRows(const Database& database, KeyTarget target)
    : database_(database),
      first_row_(target == KeyTarget::take ? 0 : std::numeric_limits<std::int64_t>::min()),
      last_row_(target == KeyTarget::take ? std::numeric_limits<std::int64_t>::max() : -1) {}

std::vector<Pair> KeyRows::next_row(Statement& rows) const {
  const Pair first = rows.integer() - first_row_;
  return unpack(first, rows.bytes());
}

std::vector<Pair> KeyRows::row_for(Pair pair) const {
  Statement before(database_,
                   "SELECT id, more FROM keys WHERE id<=? AND id>=? ORDER BY id DESC LIMIT 1");
  before.bind(first_row_ + pair).bind(first_row_);
  if (before.step()) return next_row(before);
  Statement after(database_, "SELECT id, more FROM keys WHERE id>? AND id<=? ORDER BY id LIMIT 1");
  after.bind(first_row_ + pair).bind(last_row_);
  return after.step() ? next_row(after) : std::vector<Pair>();
}

void KeyRows::write_row(std::span<const Pair> pairs) const {
  Statement(database_, "INSERT INTO keys(id, more) VALUES(?,?)")
      .bind(first_row_ + pairs.front())
      .bind(pack(pairs))
      .run();
}

void KeyRows::delete_row(Pair first) const {
  Statement(database_, "DELETE FROM keys WHERE id=?").bind(first_row_ + first).run();
}

void KeyRows::write_rows(std::span<const Pair> pairs) const {
  if (pairs.size() > most_pairs) {
    write_row(pairs.first(pairs.size() / 2));
    pairs = pairs.subspan(pairs.size() / 2);
  }
  if (!pairs.empty()) write_row(pairs);
}

void KeyRows::add(std::int64_t key, std::int64_t id) const {
  const Pair pair = pair_of(key, id);
  std::vector<Pair> pairs = row_for(pair);
  if (std::ranges::binary_search(pairs, pair)) return;
  if (!pairs.empty()) delete_row(pairs.front());
  pairs.insert(std::ranges::lower_bound(pairs, pair), pair);
  write_rows(pairs);
}

void KeyRows::remove(std::int64_t key, std::int64_t id) const {
  const Pair pair = pair_of(key, id);
  std::vector<Pair> pairs = row_for(pair);
  const auto at = std::ranges::lower_bound(pairs, pair);
  if (at == pairs.end() || *at != pair) return;
  delete_row(pairs.front());
  pairs.erase(at);
  write_rows(pairs);
}

std::vector<std::int64_t> KeyRows::find(std::int64_t first, std::int64_t last) const {
  const Pair from = pair_of(first, 0), to = pair_of(last, id_limit - 1);
  std::vector<std::int64_t> ids;
  const auto collect = [&](const std::vector<Pair>& pairs) {
    for (const Pair pair : pairs) {
      if (pair >= from && pair <= to) ids.push_back(id_of(pair));
    }
  };
  collect(row_for(from));
  Statement rows(database_, "SELECT id, more FROM keys WHERE id>? AND id<=?");
  rows.bind(first_row_ + from).bind(first_row_ + to);
  while (rows.step()) collect(next_row(rows));
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

std::size_t KeyRows::count() const {
  std::size_t count = 0;
  Pair last = -1;
  Statement rows(database_, "SELECT id, more FROM keys WHERE id>=? AND id<=? ORDER BY id");
  rows.bind(first_row_).bind(last_row_);
  while (rows.step()) {
    const std::vector<Pair> pairs = next_row(rows);
    if (pairs.front() <= last) throw_damaged();
    last = pairs.back();
    count += pairs.size();
  }
  return count;
}

}  // namespace reprise
