// Binary range coding: integers only, so that every build reads what any build wrote.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace reprise {

/// Probabilities of a 1 have 16 bits: 1 .. 65535 stand for p / 65536.
using Probability = std::uint32_t;
constexpr int probability_bits = 16;

/// What a range is kept above, byte by byte.
constexpr std::uint32_t least_coder_range = 1u << 24;
/// The part of the range that stands for a 1.
constexpr std::uint32_t part_of_range(std::uint32_t range, Probability one) {
  return (range >> probability_bits) * one;
}

class RangeEncoder {
 public:
  void encode(bool bit, Probability one);
  /// `count` bits (at most 32) at one half each, high bit first.
  void encode_plain(std::uint32_t value, int count);
  /// One of `total` (at most 2^16) numbers that are all as likely.
  void encode_uniform(std::uint32_t value, std::uint32_t total);
  /// At most 16 bits at one half each, in one step.
  void encode_bits(std::uint32_t value, int count);
  /// Ends the stream. Up to eight trailing zero bytes are left out: the decoder reads zeros past
  /// the end.
  std::vector<std::uint8_t> finish();

 private:
  void shift_low();

  std::uint64_t low_ = 0;
  std::uint32_t range_ = 0xffffffff;
  std::uint8_t cache_ = 0;
  std::uint64_t cache_size_ = 1;
  std::vector<std::uint8_t> bytes_;
};

class RangeDecoder {
 public:
  explicit RangeDecoder(std::span<const std::uint8_t> bytes);
  bool decode(Probability one);
  std::uint32_t decode_plain(int count);
  std::uint32_t decode_uniform(std::uint32_t total);
  std::uint32_t decode_bits(int count);
  /// How many bytes past the end were asked for.
  std::size_t bytes_past_end() const { return past_end_; }
  /// More than any stream of ours asks for (docs/format.md): whoever reads on reads what nobody
  /// wrote, and maybe very much of it.
  bool ran_out() const { return past_end_ > most_past_end; }

 private:
  /// Four that are read ahead, the zeros that an encoder leaves out, and some.
  static constexpr std::size_t most_past_end = 16;

  std::uint8_t next_byte();

  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
  std::size_t past_end_ = 0;
  std::uint32_t range_ = 0xffffffff;
  std::uint32_t code_ = 0;
};

inline RangeDecoder::RangeDecoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
  for (int i = 0; i < 4; ++i) code_ = code_ << 8 | next_byte();
}

inline std::uint8_t RangeDecoder::next_byte() {
  if (position_ < bytes_.size()) return bytes_[position_++];
  ++past_end_;
  return 0;
}

inline bool RangeDecoder::decode(Probability one) {
  const std::uint32_t bound = part_of_range(range_, one);
  const bool bit = code_ < bound;
  if (bit) {
    range_ = bound;
  } else {
    code_ -= bound;
    range_ -= bound;
  }
  while (range_ < least_coder_range) {
    range_ <<= 8;
    code_ = code_ << 8 | next_byte();
  }
  return bit;
}

inline std::uint32_t RangeDecoder::decode_plain(int count) {
  std::uint32_t value = 0;
  for (int b = 0; b < count; ++b) value = value << 1 | decode(1u << (probability_bits - 1));
  return value;
}

inline std::uint32_t RangeDecoder::decode_bits(int count) {
  range_ >>= count;
  // Only what no encoder wrote is past the last of the numbers.
  const std::uint32_t value = std::min(code_ / range_, (1u << count) - 1);
  code_ -= value * range_;
  while (range_ < least_coder_range) {
    range_ <<= 8;
    code_ = code_ << 8 | next_byte();
  }
  return value;
}

inline std::uint32_t RangeDecoder::decode_uniform(std::uint32_t total) {
  range_ /= total;
  // Only what no encoder wrote is past the last of the numbers.
  const std::uint32_t value = std::min(code_ / range_, total - 1);
  code_ -= value * range_;
  while (range_ < least_coder_range) {
    range_ <<= 8;
    code_ = code_ << 8 | next_byte();
  }
  return value;
}

}  // namespace reprise
