#include "exact/rounding_noise.h"

namespace reprise {
namespace {

/// 2^-62 radians in 10^-28 degrees.
constexpr std::uint64_t unit = 124'240'417'245;
constexpr int unit_exponent = 28;

std::uint64_t power_of_ten(int exponent) {
  std::uint64_t power = 1;
  for (int i = 0; i < exponent; ++i) power *= 10;
  return power;
}

}  // namespace

std::uint64_t fine_of_noise(const NumberPrinter& printer, std::uint32_t multiple) {
  const NumberFormat& format = printer.format();
  if (format.digits > 9 || multiple == 0 || multiple > most_noise) return 0;
  const std::uint64_t product = multiple * unit;
  int count = 0;
  for (std::uint64_t rest = product; rest != 0; rest /= 10) ++count;
  const int surplus = count - format.digits;  // the unit has more digits than any format here
  const std::uint64_t divisor = power_of_ten(surplus);
  std::uint64_t digits = (product + divisor / 2) / divisor;
  int first_place = count - 1 - unit_exponent;
  if (digits == power_of_ten(format.digits)) digits /= 10, ++first_place;
  const int decade = -first_place - 1 - format.decimals;
  if (decade < 0 || decade >= NumberPrinter::tiny_decades) return 0;
  return 1 + static_cast<std::uint64_t>(decade) * printer.decade_size() +
         (digits - power_of_ten(format.digits - 1));
}

std::uint32_t noise_of_fine(const NumberPrinter& printer, std::uint64_t fine) {
  const NumberFormat& format = printer.format();
  if (format.digits > 9 || fine == 0) return 0;
  const auto decade = static_cast<int>((fine - 1) / printer.decade_size());
  const std::uint64_t digits = power_of_ten(format.digits - 1) + (fine - 1) % printer.decade_size();
  // digits x 10^places units of `unit_exponent`
  const int places = unit_exponent - decade - format.decimals - format.digits;
  std::uint64_t product = digits;
  if (places < 0) {
    if (places < -9) return 0;
    product /= power_of_ten(-places);
  }
  for (int i = 0; i < places; ++i) {
    if (product > (most_noise + std::uint64_t{1}) * unit) return 0;
    product *= 10;
  }
  const std::uint64_t multiple = (product + unit / 2) / unit;
  if (multiple == 0 || multiple > most_noise) return 0;
  const auto narrow = static_cast<std::uint32_t>(multiple);
  return fine_of_noise(printer, narrow) == fine ? narrow : 0;
}

}  // namespace reprise
