#include "store/number_columns.h"

#include <algorithm>
#include <bit>

#include "reprise/error.h"

namespace reprise {
namespace {

[[noreturn]] void throw_damaged() {
  throw Error(ErrorCode::damaged, "the archive is damaged: a column of takes ends too early");
}

}  // namespace

std::uint64_t folded(std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  return value < 0 ? ~(bits << 1) : bits << 1;
}

std::int64_t unfolded(std::uint64_t value) {
  return static_cast<std::int64_t>((value & 1) != 0 ? ~(value >> 1) : value >> 1);
}

void ColumnWriter::number(std::uint64_t value) {
  for (; value >= 128; value >>= 7) bytes_.push_back(static_cast<std::uint8_t>(value | 128));
  bytes_.push_back(static_cast<std::uint8_t>(value));
}

void ColumnWriter::numbers(std::span<const std::uint64_t> values) {
  if (values.empty()) return;
  const auto [least, most] = std::ranges::minmax(values);
  const auto width = static_cast<int>(std::bit_width(most - least));
  number(least);
  bytes_.push_back(static_cast<std::uint8_t>(width));
  int used = 8;
  for (const std::uint64_t value : values) {
    for (int bit = 0; bit < width; ++bit) {
      if (used == 8) {
        bytes_.push_back(0);
        used = 0;
      }
      const auto one = static_cast<std::uint8_t>((value - least) >> bit & 1);
      bytes_.back() = static_cast<std::uint8_t>(bytes_.back() | one << used++);
    }
  }
}

void ColumnWriter::raw(std::span<const std::uint8_t> bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

std::uint64_t ColumnReader::number() {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    const std::uint8_t byte = raw(1)[0];
    value |= std::uint64_t{byte & 127u} << shift;
    if ((byte & 128) == 0) return value;
  }
  throw_damaged();
}

std::vector<std::uint64_t> ColumnReader::numbers(std::size_t count) {
  if (count == 0) return {};
  const std::uint64_t least = number();
  const std::size_t width = raw(1)[0];
  // Counts are checked by those who ask, so that this cannot run over.
  if (width > 64) throw_damaged();
  const std::span<const std::uint8_t> bits = raw((count * width + 7) / 8);
  std::vector<std::uint64_t> values(count, least);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t bit = 0; bit < width; ++bit) {
      const std::size_t at = i * width + bit;
      values[i] += std::uint64_t{static_cast<unsigned>(bits[at / 8]) >> (at % 8) & 1u} << bit;
    }
  }
  return values;
}

std::span<const std::uint8_t> ColumnReader::raw(std::size_t size) {
  if (size > bytes_.size() - at_) throw_damaged();
  at_ += size;
  return bytes_.subspan(at_ - size, size);
}

}  // namespace reprise
