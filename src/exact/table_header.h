// What is said of a table of numbers before its rows.
#pragma once

#include "exact/coding.h"
#include "exact/number_table.h"

namespace reprise {

/// Codes formats and columns; reading starts from a table with as many columns, and throws Error
/// (damaged) for what no encoder writes.
void encode_table_header(RangeEncoder& encoder, NumberTable& table,
                         const std::vector<std::string_view>& starts);
void decode_table_header(RangeDecoder& decoder, NumberTable& table,
                         const std::vector<std::string_view>& starts);

}  // namespace reprise
