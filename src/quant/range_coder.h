// Binary range coding: integers only, so that every build reads what any build wrote.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace reprise {

/// Probabilities of a 1 have 16 bits: 1 .. 65535 stand for p / 65536.
using Probability = std::uint32_t;
constexpr int probability_bits = 16;

class RangeEncoder {
 public:
  void encode(bool bit, Probability one);
  /// `count` bits (at most 32) at one half each, high bit first.
  void encode_plain(std::uint32_t value, int count);
  /// One of `total` (at most 2^16) numbers that are all as likely.
  void encode_uniform(std::uint32_t value, std::uint32_t total);
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
  /// How many bytes past the end were asked for: more than a few, and the stream is not one of
  /// ours.
  std::size_t bytes_past_end() const { return past_end_; }

 private:
  std::uint8_t next_byte();

  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
  std::size_t past_end_ = 0;
  std::uint32_t range_ = 0xffffffff;
  std::uint32_t code_ = 0;
};

}  // namespace reprise
