#include "exact/text_codec.h"

#include <algorithm>
#include <cassert>

#include "exact/number_text.h"
#include "exact/plain_frame.h"

namespace reprise {
namespace {

/// The first byte of coded texts.
enum Mode : std::uint8_t { plain = 0, numbers = 1 };
constexpr std::uint8_t mode_mask = 3;
constexpr std::uint8_t follows_known = 4;  ///< the text is what comes after the known text

}  // namespace

std::vector<std::uint8_t> encode_text(std::string_view text, std::string_view known_text) {
  const bool follows = text.starts_with(known_text);
  const std::string_view rest = follows ? text.substr(known_text.size()) : text;
  const std::uint8_t flags = follows ? follows_known : 0;
  auto coded = encode_number_text(rest, known_text);
  if (coded) {
    coded->insert(coded->begin(), static_cast<std::uint8_t>(Mode::numbers | flags));
    if (decode_text(*coded, known_text) != text) coded.reset();
  }
  if (coded && coded->size() * 2 < rough_plain_size(rest)) return std::move(*coded);
  std::vector<std::uint8_t> plainly = {static_cast<std::uint8_t>(Mode::plain | flags)};
  const auto frame = compress_plain(rest);
  plainly.insert(plainly.end(), frame.begin(), frame.end());
  if (coded && coded->size() < plainly.size()) return std::move(*coded);
  assert(decode_text(plainly, known_text) == text);
  return plainly;
}

std::string decode_text(std::span<const std::uint8_t> coded, std::string_view known_text,
                        std::size_t most) {
  most = std::min(most, TextLimits::bytes);
  if (coded.empty()) throw_damaged_text("it is empty");
  const std::uint8_t mode = coded.front() & mode_mask;
  if ((coded.front() & ~(mode_mask | follows_known)) != 0)
    throw_damaged_text("it is of no known kind");
  std::string text;
  if ((coded.front() & follows_known) != 0) text.append(known_text);
  const std::span<const std::uint8_t> rest = coded.subspan(1);
  if (mode == Mode::plain) {
    text.append(decompress_plain(rest, most));
  } else if (mode == Mode::numbers) {
    decode_number_text(rest, known_text, most, text);
  } else {
    throw_damaged_text("it is of no known kind");
  }
  if (text.size() > most) throw_damaged_text("it is longer than it is said to be");
  return text;
}

}  // namespace reprise
