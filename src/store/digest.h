// Digests: BLAKE2b of a canonical sequence of bytes, the same on every machine.
#pragma once

#include <sodium.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "store/archive_store.h"

namespace reprise {

/// Numbers go in as 8 bytes, low byte first; texts and bytes with their length before them, but for
/// add(text) and add(bytes), which put in the bytes alone.
class Hasher {
 public:
  Hasher();
  void add(std::string_view text);
  void add(std::span<const std::uint8_t> bytes);
  void add_number(std::int64_t value);
  void add_real(double value);
  void add_text(std::string_view text);
  void add_bytes(std::span<const std::uint8_t> bytes);
  Digest finish();

 private:
  crypto_generichash_state state_;
};

Digest digest_of(std::string_view text);
Digest digest_of(std::span<const std::uint8_t> bytes);

std::string hexadecimal(std::span<const std::uint8_t> bytes);
/// The bytes of hexadecimal digits; empty where they are not.
Bytes from_hexadecimal(std::string_view digits);

/// The first eight bytes.
ShortDigest shortened(const Digest& digest);

/// A sum (modulo 2^128) of digests, which does not depend on their order.
void add_to_sum(Digest& sum, const Digest& digest);
void subtract_from_sum(Digest& sum, const Digest& digest);

}  // namespace reprise
