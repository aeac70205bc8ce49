#include "exact/number_text.h"

#include <algorithm>

#include "exact/damaged_text.h"
#include "exact/expected_starts.h"
#include "exact/number_coder.h"
#include "exact/plain_frame.h"
#include "exact/table_header.h"
#include "exact/text_layout.h"

namespace reprise {
namespace {

constexpr std::size_t most_columns = 1u << 16;

/// What follows a row.
struct RowKinds {
  BitCounter usual, odd;
};

void append_length(std::vector<std::uint8_t>& bytes, std::size_t length) {
  for (; length >= 128; length >>= 7) bytes.push_back(static_cast<std::uint8_t>(length | 128));
  bytes.push_back(static_cast<std::uint8_t>(length));
}

std::size_t take_length(std::span<const std::uint8_t>& bytes) {
  std::size_t length = 0;
  for (int shift = 0; shift < 35; shift += 7) {
    if (bytes.empty()) throw_damaged_text("it ends too early");
    const std::uint8_t byte = bytes.front();
    bytes = bytes.subspan(1);
    length |= static_cast<std::size_t>(byte & 127) << shift;
    if (byte < 128) return length;
  }
  throw_damaged_text("a length is too long");
}

/// Header, pattern, odd frames and escaped numbers, in the order in which a decoder needs them.
std::string text_beside_numbers(const TextLayout& layout, const NumberTable& table) {
  std::string text(layout.header);
  text.push_back(string_end);
  text.append(layout.pattern);
  text.push_back(string_end);
  std::size_t next = 0;
  for (const auto& frame : layout.frames) {
    if (frame.odd) {
      text.append(frame.text);
      text.push_back(string_end);
      continue;
    }
    for (const std::size_t end = next + layout.slots; next < end; ++next) {
      if (!table.escaped[next]) continue;
      text.append(layout.numbers[next]);
      text.push_back(string_end);
    }
  }
  return text;
}

/// Reads strings up to their ends.
class Strings {
 public:
  explicit Strings(std::string_view text) : rest_(text) {}
  std::string_view next() {
    const std::size_t end = rest_.find(string_end);
    if (end == std::string_view::npos) throw_damaged_text("a string is missing");
    const std::string_view string = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return string;
  }

 private:
  std::string_view rest_;
};

class NumbersDecoder {
 public:
  NumbersDecoder(std::span<const std::uint8_t> bits, std::string_view beside,
                 std::string_view known_text)
      : decoder_(bits), coding_(decoder_), strings_(beside), starts_(expected_starts(known_text)) {}

  /// Up to `most` bytes, and what the last row has too much.
  void append_to(std::string& text, std::size_t most) {
    text.append(strings_.next());
    const auto pieces = pieces_of(strings_.next());
    NumberTable table;
    if (pieces.size() - 1 > most_columns) throw_damaged_text("it has too many columns");
    table.columns.resize(pieces.size() - 1);
    decode_table_header(decoder_, table, starts_);
    const std::size_t cut = coding_.number(0);
    if (cut > most) throw_damaged_text("it is cut by more than it has");
    NumberCoder coder(table);
    prepare(coder, pieces);
    std::vector<CodedNumber> numbers(table.columns.size());
    std::vector<std::uint8_t> escaped(table.columns.size());
    for (std::size_t c = 0; c < numbers.size(); ++c) numbers[c] = table.columns[c].first;
    RowKinds kinds;
    for (;;) {
      if (coding_.at_end()) throw_damaged_text("it ends too early");
      if (text.size() > most + cut) throw_damaged_text("it is longer than it is said to be");
      if (coding_.bit(kinds.usual, false)) {
        coder.code_row(coding_, {numbers, escaped});
        append_row(coder, numbers, escaped, text);
      } else if (coding_.bit(kinds.odd, false)) {
        text.append(strings_.next());
      } else {
        break;
      }
    }
    if (cut > text.size()) throw_damaged_text("it is cut by more than it has");
    text.erase(text.size() - cut);
  }

 private:
  /// The text from the start of a row, or the last changing number, up to a changing number.
  struct Piece {
    std::string text;
    std::size_t column = 0;
  };

  void prepare(const NumberCoder& coder, const std::vector<std::string_view>& pieces) {
    std::string text;
    for (std::size_t c = 0; c + 1 < pieces.size(); ++c) {
      text.append(pieces[c]);
      if (coder.columns()[c].constant) {
        coder.printer(c).print(coder.columns()[c].first, text);
      } else {
        pieces_.push_back({std::move(text), c});
        text.clear();
      }
    }
    text.append(pieces.back());
    end_ = std::move(text);
  }

  void append_row(const NumberCoder& coder, std::span<const CodedNumber> numbers,
                  std::span<const std::uint8_t> escaped, std::string& text) {
    for (const Piece& piece : pieces_) {
      text.append(piece.text);
      if (escaped[piece.column] != 0) {
        text.append(strings_.next());
      } else {
        coder.printer(piece.column).print(numbers[piece.column], text);
      }
    }
    text.append(end_);
  }

  RangeDecoder decoder_;
  Reading coding_;
  Strings strings_;
  std::vector<std::string_view> starts_;
  std::vector<Piece> pieces_;
  std::string end_;
};

}  // namespace

std::optional<std::vector<std::uint8_t>> encode_number_text(std::string_view text,
                                                            std::string_view known_text) {
  const TextLayout layout = read_layout(text);
  if (layout.slots == 0 || layout.slots > most_columns) return std::nullopt;
  NumberTable table = read_numbers(layout.numbers, layout.slots);
  if (table.numbers.empty()) return std::nullopt;
  RangeEncoder encoder;
  encode_table_header(encoder, table, expected_starts(known_text));
  Writing coding(encoder);
  coding.number(static_cast<std::uint32_t>(layout.cut));
  NumberCoder coder(table);
  RowKinds kinds;
  std::vector<std::uint8_t> escaped(layout.slots);
  std::size_t next = 0;
  for (const auto& frame : layout.frames) {
    coding.bit(kinds.usual, !frame.odd);
    if (frame.odd) {
      coding.bit(kinds.odd, true);
      continue;
    }
    std::copy_n(table.escaped.begin() + static_cast<std::ptrdiff_t>(next), layout.slots,
                escaped.begin());
    coder.code_row(coding, {std::span(table.numbers).subspan(next, layout.slots), escaped});
    next += layout.slots;
  }
  coding.bit(kinds.usual, false);
  coding.bit(kinds.odd, false);

  std::vector<std::uint8_t> coded;
  const auto beside = compress_plain(text_beside_numbers(layout, table));
  append_length(coded, beside.size());
  coded.insert(coded.end(), beside.begin(), beside.end());
  const auto bits = encoder.finish();
  coded.insert(coded.end(), bits.begin(), bits.end());
  return coded;
}

void decode_number_text(std::span<const std::uint8_t> coded, std::string_view known_text,
                        std::size_t most, std::string& text) {
  const std::size_t length = take_length(coded);
  if (length > coded.size()) throw_damaged_text("it ends too early");
  // Strings of the text with their ends, and a pattern that is no longer than one of its frames.
  const std::size_t most_beside = std::min(3 * most + 2, TextLimits::bytes);
  const std::string beside = decompress_plain(coded.first(length), most_beside);
  NumbersDecoder(coded.subspan(length), beside, known_text).append_to(text, most);
}

}  // namespace reprise
