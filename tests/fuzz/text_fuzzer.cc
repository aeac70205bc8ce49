// Any text through the exact coder comes back byte for byte.
#include "exact/text_codec.h"
#include "fuzz/fuzz_input.h"

using namespace reprise;

/// Input: how much of the text is known to the decoder (2 bytes), the text.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzInput input(data, size);
  const std::size_t known = input.number(2);
  const std::string_view text = input.text();
  const std::string_view known_text = text.substr(0, std::min(known, text.size()));
  const std::vector<std::uint8_t> coded = encode_text(text, known_text);
  expect(decode_text(coded, known_text, text.size()) == text, "a text comes back byte for byte");
  return 0;
}
