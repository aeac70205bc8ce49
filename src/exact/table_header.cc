#include "exact/table_header.h"

#include <bit>

#include "reprise/error.h"

namespace reprise {
namespace {

constexpr int most_format_bits = 5;
/// Of twice the difference of two indices.
constexpr std::uint32_t most_width = 43;
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
  std::array<BitCounter, 2> same_format, constant, escapes, twin, references, fine;
  std::array<BitCounter, 64> widths;
  std::array<BitCounter, 128> distances;
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

/// Columns are named by how far back they are; most are near.
template <class Coding>
void code_references(Coding& coding, HeaderModel& model, std::size_t column,
                     ColumnReferences& references) {
  constexpr std::uint32_t far = 127;
  for (std::uint32_t& reference : references) {
    if (!coding.bit(model.references[0], reference != 0)) return;
    const auto back = static_cast<std::uint32_t>(column - reference);
    const std::uint32_t near = code_symbol(coding, model.distances, 7, std::min(back, far));
    const std::uint32_t distance = near < far ? near : far + coding.number(back - far);
    if (distance >= column) throw Error(ErrorCode::damaged, "a coded text has a wrong column");
    reference = static_cast<std::uint32_t>(column) - distance;
  }
}

/// The number of a column that never changes, next to its start.
template <class Coding>
void code_constant(Coding& coding, HeaderModel& model, const NumberPrinter& printer,
                   NumberColumn& column) {
  const std::int64_t start = index_of(printer.grid(), column.start);
  const std::int64_t away = column.first.index - start;
  const auto given = static_cast<std::uint64_t>(away < 0 ? -2 * away - 1 : 2 * away);
  const std::uint32_t width =
      code_symbol(coding, model.widths, 6, static_cast<std::uint32_t>(std::bit_width(given)));
  if (width > most_width) throw Error(ErrorCode::damaged, "a coded text has too large a number");
  std::uint64_t zigzag = width == 0 ? 0 : 1;
  for (auto rest = static_cast<int>(width) - 1; rest > 0;) {
    const int count = std::min(rest, 16);
    rest -= count;
    const std::uint32_t mask = (1u << count) - 1;
    zigzag = zigzag << count | coding.bits(static_cast<std::uint32_t>(given >> rest) & mask, count);
  }
  const auto half = static_cast<std::int64_t>(zigzag >> 1);
  column.first.index = start + ((zigzag & 1) != 0 ? -half - 1 : half);
  if (coding.bit(model.fine[0], column.first.fine != 0)) {
    column.first.fine =
        static_cast<std::uint64_t>(code_wide(coding, static_cast<std::int64_t>(column.first.fine)));
  }
}

template <class Coding>
void code_header(Coding& coding, NumberTable& table, const std::vector<std::string_view>& starts) {
  HeaderModel model;
  table.formats.resize(
      1 + coding.uniform(static_cast<std::uint32_t>(table.formats.size() - 1), most_formats));
  for (NumberFormat& format : table.formats) {
    format = code_format(coding, format);
    if (!is_valid(format)) throw Error(ErrorCode::damaged, "a coded text has an unknown format");
  }
  const std::vector<NumberPrinter> printers(table.formats.begin(), table.formats.end());
  NumberColumn last;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    NumberColumn& column = table.columns[c];
    if (coding.bit(model.same_format[0], column.format == last.format)) {
      column.format = last.format;
    } else {
      column.format = static_cast<std::uint8_t>(
          coding.uniform(column.format, static_cast<std::uint32_t>(table.formats.size())));
    }
    if (c < starts.size()) {
      column.start = approximate_value(starts[c], table.formats[column.format].decimals);
    }
    column.constant = coding.bit(model.constant[last.constant], column.constant);
    if (column.constant) {
      code_constant(coding, model, printers[column.format], column);
    } else {
      column.escapes = coding.bit(model.escapes[last.escapes], column.escapes);
      if (coding.bit(model.twin[last.twin != 0], column.twin != 0)) {
        column.twin = 1 + coding.number(column.twin - 1);
        if (column.twin > c) throw Error(ErrorCode::damaged, "a coded text has a wrong column");
      } else {
        code_references(coding, model, c, column.references);
      }
    }
    last = column;
  }
}

}  // namespace

void encode_table_header(RangeEncoder& encoder, NumberTable& table,
                         const std::vector<std::string_view>& starts) {
  Writing writing(encoder);
  code_header(writing, table, starts);
}

void decode_table_header(RangeDecoder& decoder, NumberTable& table,
                         const std::vector<std::string_view>& starts) {
  Reading reading(decoder);
  table.formats.resize(1);
  code_header(reading, table, starts);
}

}  // namespace reprise
