#include "quant/known_values.h"

#include <algorithm>

#include "quant/bit_model.h"
#include "quant/decimal_values.h"
#include "reprise/error.h"

namespace reprise {
namespace {

Probability probability_of(const BitCounter& counter) {
  return std::clamp<Probability>(counter.probability, 64, 65472);
}

}  // namespace

std::vector<std::uint8_t> encode_known_values(const KnownValues& known) {
  if (std::ranges::all_of(known, &std::vector<double>::empty)) return {};
  RangeEncoder encoder;
  BitCounter counter;
  for (const std::vector<double>& values : known) {
    for (std::size_t count = 0; count < KnownValueLimits::values; ++count) {
      const bool more = count < values.size();
      encoder.encode(more, probability_of(counter));
      counter.update(more);
      if (!more) break;
      encode_decimal(encoder, values[count]);
    }
  }
  return encoder.finish();
}

KnownValues decode_known_values(std::span<const std::uint8_t> bytes, std::size_t channels) {
  KnownValues known(channels);
  if (bytes.empty()) return known;
  RangeDecoder decoder(bytes);
  BitCounter counter;
  for (std::vector<double>& values : known) {
    while (values.size() < KnownValueLimits::values) {
      const bool more = decoder.decode(probability_of(counter));
      counter.update(more);
      if (!more) break;
      values.push_back(decode_decimal(decoder));
    }
  }
  if (decoder.ran_out()) {
    throw Error(ErrorCode::damaged, "the values of a skeleton are not as they were written");
  }
  return known;
}

}  // namespace reprise
