#include "exact/table_header.h"

#include "reprise/error.h"

namespace reprise {
namespace {

constexpr int most_format_bits = 5;
static_assert(most_formats == 1u << most_format_bits);

/// A signed index or fine part, which may have 64 bits.
template <class Coding>
std::int64_t code_wide(Coding& coding, std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  const std::uint64_t low = coding.number(static_cast<std::uint32_t>(bits & 0x7fffffff));
  const std::uint64_t high = coding.number(static_cast<std::uint32_t>(bits >> 31 & 0x7fffffff));
  const std::uint64_t top = coding.number(static_cast<std::uint32_t>(bits >> 62));
  return static_cast<std::int64_t>(top << 62 | high << 31 | low);
}

struct HeaderModel {
  std::array<BitCounter, 2> same_format, constant, escapes, twin, usual;
};

template <class Coding>
NumberFormat code_format(Coding& coding, const NumberFormat& format) {
  const auto byte = [&](std::uint8_t value) {
    return static_cast<std::uint8_t>(coding.uniform(value, 32));
  };
  NumberFormat coded;
  coded.style = static_cast<NumberStyle>(byte(static_cast<std::uint8_t>(format.style)));
  coded.grid = static_cast<GridKind>(byte(static_cast<std::uint8_t>(format.grid)));
  coded.decimals = byte(format.decimals);
  coded.digits = byte(format.digits);
  coded.exponent_digits = byte(format.exponent_digits);
  return coded;
}

bool is_valid(const NumberFormat& format) {
  const bool general = format.style == NumberStyle::general;
  return format.style <= NumberStyle::general && format.grid <= GridKind::single &&
         format.decimals <= NumberGrid::most_decimals && format.digits >= 1 &&
         format.digits <= (general ? 17 : NumberGrid::most_decimals) &&
         format.exponent_digits >= 1 && format.exponent_digits <= 4;
}

template <class Coding>
void code_header(Coding& coding, NumberTable& table, const std::vector<CodedNumber>& usual) {
  HeaderModel model;
  table.formats.resize(
      1 + coding.uniform(static_cast<std::uint32_t>(table.formats.size() - 1), most_formats));
  for (NumberFormat& format : table.formats) {
    format = code_format(coding, format);
    if (!is_valid(format)) throw Error(ErrorCode::damaged, "a coded text has an unknown format");
  }
  NumberColumn last;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    NumberColumn& column = table.columns[c];
    if (coding.bit(model.same_format[0], column.format == last.format)) {
      column.format = last.format;
    } else {
      column.format = static_cast<std::uint8_t>(
          coding.uniform(column.format, static_cast<std::uint32_t>(table.formats.size())));
    }
    column.constant = coding.bit(model.constant[last.constant], column.constant);
    if (column.constant) {
      const CodedNumber* const known = c < usual.size() ? &usual[c] : nullptr;
      if (known != nullptr && coding.bit(model.usual[0], column.first == *known)) {
        column.first = *known;
      } else {
        column.first.index = code_wide(coding, column.first.index);
        column.first.fine = static_cast<std::uint64_t>(
            code_wide(coding, static_cast<std::int64_t>(column.first.fine)));
      }
    } else {
      column.escapes = coding.bit(model.escapes[last.escapes], column.escapes);
      if (coding.bit(model.twin[last.twin != 0], column.twin != 0)) {
        column.twin = 1 + coding.number(column.twin - 1);
        if (column.twin > c) throw Error(ErrorCode::damaged, "a coded text has a wrong column");
      }
    }
    last = column;
  }
}

}  // namespace

void encode_table_header(RangeEncoder& encoder, const NumberTable& table,
                         const std::vector<CodedNumber>& usual) {
  Writing writing(encoder);
  NumberTable copy{table.formats, table.columns, {}, {}};
  code_header(writing, copy, usual);
}

void decode_table_header(RangeDecoder& decoder, NumberTable& table,
                         const std::vector<CodedNumber>& usual) {
  Reading reading(decoder);
  table.formats.resize(1);
  code_header(reading, table, usual);
}

}  // namespace reprise
