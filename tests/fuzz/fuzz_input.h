// What a fuzzer is given, taken from the front: choices first, then the bytes at hand.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reprise {

class FuzzInput {
 public:
  FuzzInput(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}

  bool empty() const { return rest_.empty(); }
  /// The next `count` bytes as a number, low byte first; zeros past the end.
  std::uint64_t number(std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t b = 0; b < count && !rest_.empty(); ++b) {
      value |= std::uint64_t{rest_.front()} << (8 * b);
      rest_ = rest_.subspan(1);
    }
    return value;
  }
  /// 0 .. count - 1 of one byte.
  std::size_t choice(std::size_t count) { return number(1) % count; }
  std::vector<std::uint8_t> bytes(std::size_t count) {
    const auto taken = rest_.first(std::min(count, rest_.size()));
    rest_ = rest_.subspan(taken.size());
    return {taken.begin(), taken.end()};
  }
  std::span<const std::uint8_t> rest() const { return rest_; }
  std::string_view text() const {
    return {reinterpret_cast<const char*>(rest_.data()), rest_.size()};
  }

 private:
  std::span<const std::uint8_t> rest_;
};

/// Ends the run with a finding: a promise of the library that does not hold.
inline void expect(bool holds, const std::string& promise) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", promise.c_str());
  std::abort();
}

}  // namespace reprise
