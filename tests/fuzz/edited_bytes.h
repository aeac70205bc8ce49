// Edits of bytes that a fuzzer may make: small changes at any place, so that what is far inside
// long bytes is reached by short inputs.
#pragma once

#include "fuzz/fuzz_input.h"

namespace reprise {

/// Cuts, takes a part out, puts bytes in, or writes over some. Something is always changed. An edit
/// takes 4 to 20 bytes of the input.
template <class Bytes>
void edit(Bytes& bytes, FuzzInput& input) {
  const Bytes before = bytes;
  const std::size_t what = input.choice(8);
  const auto at = static_cast<std::ptrdiff_t>(bytes.empty() ? 0 : input.number(3) % bytes.size());
  const std::size_t left = bytes.size() - static_cast<std::size_t>(at);
  switch (what) {
    case 0:
      bytes.resize(static_cast<std::size_t>(at));
      break;
    case 1:
      bytes.erase(bytes.begin() + at,
                  bytes.begin() + at +
                      static_cast<std::ptrdiff_t>(std::min<std::size_t>(left, input.number(1))));
      break;
    case 2: {
      const std::vector<std::uint8_t> more = input.bytes(input.choice(16));
      bytes.insert(bytes.begin() + at, more.begin(), more.end());
      break;
    }
    default: {
      const std::vector<std::uint8_t> over = input.bytes(what - 2);
      std::copy_n(over.begin(), std::min(over.size(), left), bytes.begin() + at);
    }
  }
  if (bytes != before) return;
  if (bytes.empty()) {
    bytes.push_back(1);
  } else {
    auto& changed = bytes[static_cast<std::size_t>(at)];
    changed = static_cast<typename Bytes::value_type>(changed ^ 1);
  }
}

}  // namespace reprise
