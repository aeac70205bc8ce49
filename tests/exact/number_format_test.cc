#include "exact/number_format.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

namespace reprise {
namespace {

std::string printed(const char* format, double value) {
  char text[64];
  const int length = std::snprintf(text, sizeof text, format, value);
  return {text, static_cast<std::size_t>(length)};
}

/// Magnitudes from far below a unit to a thousand, of both signs.
double any_number(std::mt19937& random) {
  std::uniform_real_distribution<double> part(-1, 1), exponent(-18, 3);
  return part(random) * std::pow(10.0, exponent(random));
}

TEST(NumberFormat, WhatPrintfWritesComesBack) {
  std::mt19937 random(1);
  for (const int digits : {3, 6, 9, 15}) {
    NumberFormat general{NumberStyle::general, GridKind::significant,
                         static_cast<std::uint8_t>(std::min(digits, 9)),
                         static_cast<std::uint8_t>(digits), 2};
    const NumberPrinter printer(general);
    const std::string format = "%." + std::to_string(digits) + "g";
    for (int i = 0; i < 20'000; ++i) {
      const std::string word = printed(format.c_str(), any_number(random));
      const auto number = printer.parse(word);
      ASSERT_TRUE(number) << word;
      std::string again;
      printer.print(*number, again);
      ASSERT_EQ(again, word);
    }
  }
}

TEST(NumberFormat, GridsHoldWhatTheyShould) {
  std::mt19937 random(2);
  const NumberPrinter linear({NumberStyle::fixed, GridKind::linear, 6, 9, 2});
  const NumberPrinter single({NumberStyle::fixed, GridKind::single, 6, 9, 2});
  const NumberPrinter significant({NumberStyle::fixed, GridKind::significant, 6, 6, 2});
  for (int i = 0; i < 20'000; ++i) {
    const double value = any_number(random);
    EXPECT_TRUE(linear.parse(printed("%.6f", value)));
    EXPECT_TRUE(single.parse(printed("%.6f", static_cast<float>(value))));
    EXPECT_TRUE(significant.parse(printed("%.6f", std::stod(printed("%.6g", value)))));
  }
  EXPECT_FALSE(single.parse("200.000001"));
  EXPECT_FALSE(significant.parse("200.000100"));
}

TEST(NumberFormat, IndicesCountUpwardsWithoutGaps) {
  for (const GridKind kind : {GridKind::linear, GridKind::significant, GridKind::single}) {
    for (const int decimals : {0, 3, 6, 9}) {
      const NumberGrid grid(kind, decimals, 6);
      std::mt19937_64 random(3);
      for (int i = 0; i < 20'000; ++i) {
        const auto magnitude =
            static_cast<std::int64_t>(random() % NumberGrid::most_magnitude) >> (random() % 40);
        const std::int64_t index = grid.index_of(magnitude);
        const std::int64_t nearest = grid.magnitude_of(index);
        ASSERT_EQ(grid.index_of(nearest), index);
        if (index == 0 || grid.magnitude_of(index + 1) == 0) continue;
        ASSERT_LT(nearest, grid.magnitude_of(index + 1));
        ASSERT_GT(nearest, grid.magnitude_of(index - 1));
      }
    }
  }
}

TEST(NumberFormat, OtherWaysToWriteANumberAreRefused) {
  const NumberPrinter fixed({NumberStyle::fixed, GridKind::linear, 6, 9, 2});
  for (const char* word : {"1", "1.", ".5", "+1.000000", "01.000000", "1.00000", "1e-3",
                           "1.0000000", "", "-", "1.000000e0", "99999999999999999999.000000"}) {
    EXPECT_FALSE(fixed.parse(word)) << word;
  }
  EXPECT_TRUE(fixed.parse("-0.000000"));
  const NumberPrinter general({NumberStyle::general, GridKind::significant, 6, 6, 3});
  for (const char* word : {"1.0", "0.1e1", "1e-05", "1E-005", "0.00001", "+1", ".5", "-.5", "00"}) {
    EXPECT_FALSE(general.parse(word)) << word;
  }
  for (const char* word : {"-0", "0", "1e-005", "3.64024e-015", "123456", "1.5", "0.0001"}) {
    EXPECT_TRUE(general.parse(word)) << word;
  }
}

}  // namespace
}  // namespace reprise
