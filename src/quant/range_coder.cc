#include "quant/range_coder.h"

#include <algorithm>

namespace reprise {
namespace {

/// So that a decoder which wants many more bytes than there are knows that something is wrong.
constexpr int most_left_out = 8;

}  // namespace

void RangeEncoder::encode(bool bit, Probability one) {
  const std::uint32_t bound = part_of_range(range_, one);
  if (bit) {
    range_ = bound;
  } else {
    low_ += bound;
    range_ -= bound;
  }
  while (range_ < least_coder_range) {
    range_ <<= 8;
    shift_low();
  }
}

void RangeEncoder::encode_plain(std::uint32_t value, int count) {
  for (int b = count - 1; b >= 0; --b) encode((value >> b & 1) != 0, 1u << (probability_bits - 1));
}

void RangeEncoder::encode_uniform(std::uint32_t value, std::uint32_t total) {
  range_ /= total;
  low_ += static_cast<std::uint64_t>(range_) * value;
  while (range_ < least_coder_range) {
    range_ <<= 8;
    shift_low();
  }
}

void RangeEncoder::encode_bits(std::uint32_t value, int count) {
  range_ >>= count;
  low_ += static_cast<std::uint64_t>(range_) * value;
  while (range_ < least_coder_range) {
    range_ <<= 8;
    shift_low();
  }
}

void RangeEncoder::shift_low() {
  if (low_ < 0xff000000u || low_ > 0xffffffffu) {
    const auto carry = static_cast<std::uint8_t>(low_ >> 32);
    std::uint8_t byte = cache_;
    do {
      bytes_.push_back(static_cast<std::uint8_t>(byte + carry));
      byte = 0xff;
    } while (--cache_size_ != 0);
    cache_ = static_cast<std::uint8_t>(low_ >> 24);
  }
  ++cache_size_;
  low_ = (low_ & 0x00ffffffu) << 8;
}

std::vector<std::uint8_t> RangeEncoder::finish() {
  // Of all the numbers in [low, low + range) take one that ends in as many zeros as can be.
  for (int zeros = 31; zeros >= 0; --zeros) {
    const std::uint64_t mask = (std::uint64_t{1} << zeros) - 1;
    const std::uint64_t candidate = (low_ + mask) & ~mask;
    if (candidate < low_ + range_) {
      low_ = candidate;
      break;
    }
  }
  for (int i = 0; i < 5; ++i) shift_low();
  // The first byte is always the cache that was there before anything was coded.
  bytes_.erase(bytes_.begin());
  for (int left_out = 0; left_out < most_left_out && !bytes_.empty() && bytes_.back() == 0;
       ++left_out) {
    bytes_.pop_back();
  }
  return std::move(bytes_);
}

}  // namespace reprise
