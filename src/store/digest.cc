#include "store/digest.h"

#include <bit>
#include <cstring>

namespace reprise {

Hasher::Hasher() {
  // Choosing the fastest implementation for this machine is safe to repeat, also from several
  // threads.
  static const bool ready = sodium_init() >= 0;
  (void)ready;
  crypto_generichash_init(&state_, nullptr, 0, Digest{}.size());
}

void Hasher::add(std::string_view text) {
  crypto_generichash_update(&state_, reinterpret_cast<const unsigned char*>(text.data()),
                            text.size());
}

void Hasher::add(std::span<const std::uint8_t> bytes) {
  crypto_generichash_update(&state_, bytes.data(), bytes.size());
}

void Hasher::add_number(std::int64_t value) {
  std::array<std::uint8_t, 8> bytes;
  for (std::size_t b = 0; b < 8; ++b) {
    bytes[b] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * b));
  }
  add(bytes);
}

void Hasher::add_real(double value) { add_number(std::bit_cast<std::int64_t>(value)); }

void Hasher::add_text(std::string_view text) {
  add_number(static_cast<std::int64_t>(text.size()));
  add(text);
}

void Hasher::add_bytes(std::span<const std::uint8_t> bytes) {
  add_number(static_cast<std::int64_t>(bytes.size()));
  add(bytes);
}

Digest Hasher::finish() {
  Digest digest;
  crypto_generichash_final(&state_, digest.data(), digest.size());
  return digest;
}

Digest digest_of(std::string_view text) {
  Hasher hasher;
  hasher.add(text);
  return hasher.finish();
}

Digest digest_of(std::span<const std::uint8_t> bytes) {
  Hasher hasher;
  hasher.add(bytes);
  return hasher.finish();
}

std::string hexadecimal(std::span<const std::uint8_t> bytes) {
  constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

Bytes from_hexadecimal(std::string_view digits) {
  Bytes bytes;
  if (digits.size() % 2 != 0) return bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    int value = 0;
    for (const char c : digits.substr(i, 2)) {
      const auto place = std::string_view("0123456789abcdef").find(c);
      if (place == std::string_view::npos) return {};
      value = value * 16 + static_cast<int>(place);
    }
    bytes.push_back(static_cast<std::uint8_t>(value));
  }
  return bytes;
}

ShortDigest shortened(const Digest& digest) {
  ShortDigest result;
  std::memcpy(result.data(), digest.data(), result.size());
  return result;
}

void add_to_sum(Digest& sum, const Digest& digest) {
  unsigned carry = 0;
  for (std::size_t b = 0; b < sum.size(); ++b) {
    carry += static_cast<unsigned>(sum[b]) + digest[b];
    sum[b] = static_cast<std::uint8_t>(carry);
    carry >>= 8;
  }
}

void subtract_from_sum(Digest& sum, const Digest& digest) {
  int borrow = 0;
  for (std::size_t b = 0; b < sum.size(); ++b) {
    const int difference = static_cast<int>(sum[b]) - digest[b] - borrow;
    sum[b] = static_cast<std::uint8_t>(difference);
    borrow = difference < 0;
  }
}

}  // namespace reprise
