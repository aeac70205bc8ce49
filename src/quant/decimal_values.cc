#include "quant/decimal_values.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace reprise {
namespace {

constexpr std::array<double, 10> powers_of_ten = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
constexpr int most_decimals = 9;
/// In place of the number of decimals: the number's own 64 bits follow.
constexpr std::uint32_t as_it_is = 15;
constexpr int decimals_bits = 4, width_bits = 6, most_width = 52;

void encode_wide(RangeEncoder& encoder, std::uint64_t value, int bits) {
  if (bits > 32) encoder.encode_plain(static_cast<std::uint32_t>(value >> 32), bits - 32);
  encoder.encode_plain(static_cast<std::uint32_t>(value), std::min(bits, 32));
}

std::uint64_t decode_wide(RangeDecoder& decoder, int bits) {
  std::uint64_t high = 0;
  if (bits > 32) high = decoder.decode_plain(bits - 32);
  return high << 32 | decoder.decode_plain(std::min(bits, 32));
}

}  // namespace

void encode_decimal(RangeEncoder& encoder, double value) {
  for (int decimals = 0; decimals <= most_decimals; ++decimals) {
    const double scale = powers_of_ten[static_cast<std::size_t>(decimals)];
    const double whole = std::round(std::abs(value) * scale);
    if (!(whole < std::ldexp(1.0, most_width))) break;
    if (whole / scale != std::abs(value)) continue;
    const auto number = static_cast<std::uint64_t>(whole);
    const auto width = static_cast<int>(std::bit_width(number));
    encoder.encode_plain(static_cast<std::uint32_t>(decimals), decimals_bits);
    encoder.encode_plain(static_cast<std::uint32_t>(width), width_bits);
    if (width == 0) return;
    encode_wide(encoder, number, width);
    encoder.encode_plain(value < 0, 1);
    return;
  }
  encoder.encode_plain(as_it_is, decimals_bits);
  encode_wide(encoder, std::bit_cast<std::uint64_t>(value), 64);
}

double decode_decimal(RangeDecoder& decoder) {
  const std::uint32_t decimals = decoder.decode_plain(decimals_bits);
  if (decimals > most_decimals) {
    const auto value = std::bit_cast<double>(decode_wide(decoder, 64));
    return std::isfinite(value) ? value : 0;
  }
  const auto width = static_cast<int>(decoder.decode_plain(width_bits));
  if (width == 0) return 0;
  const auto whole = static_cast<double>(decode_wide(decoder, width));
  const double value = whole / powers_of_ten[decimals];
  return decoder.decode_plain(1) != 0 ? -value : value;
}

}  // namespace reprise
