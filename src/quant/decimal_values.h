// Numbers as they are written in files: few decimals, or any double.
#pragma once

#include "quant/range_coder.h"

namespace reprise {

/// Any finite number: as a whole number over a power of ten where that is the number exactly (up to
/// 9 decimals and 52 bits), else as its 64 bits.
void encode_decimal(RangeEncoder& encoder, double value);
/// Whatever the bits are, gives a finite number.
double decode_decimal(RangeDecoder& decoder);

}  // namespace reprise
