// docs/limits.md is what users read; InputLimits is what the readers hold to.
#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <map>
#include <string>

#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

// Rows of the form "| `name` | 1,234 | ... |".
std::map<std::string, std::size_t> documented_limits() {
  std::ifstream document(REPRISE_LIMITS_DOCUMENT);
  std::map<std::string, std::size_t> limits;
  for (std::string line; std::getline(document, line);) {
    if (!line.starts_with("| `")) continue;
    const std::size_t name_end = line.find('`', 3);
    const std::size_t value_begin = line.find('|', name_end) + 1;
    std::string digits;
    for (const char c : line.substr(value_begin, line.find('|', value_begin) - value_begin)) {
      if (std::isdigit(static_cast<unsigned char>(c)) != 0) digits += c;
    }
    limits[line.substr(3, name_end - 3)] = std::stoull(digits);
  }
  return limits;
}

TEST(LimitsDocument, StatesTheLimitsOfTheReaders) {
  const std::map<std::string, std::size_t> expected = {
      {"joints", InputLimits::joints},
      {"channels", InputLimits::channels},
      {"depth", InputLimits::depth},
      {"channels_per_value", InputLimits::channels_per_value},
      {"name_bytes", InputLimits::name_bytes},
      {"number_bytes", InputLimits::number_bytes},
      {"magnitude", InputLimits::magnitude},
      {"line_bytes", InputLimits::line_bytes},
      {"file_bytes", InputLimits::file_bytes},
  };
  EXPECT_EQ(documented_limits(), expected);
}

}  // namespace
}  // namespace reprise
