#include "cli/text.h"

#include <gtest/gtest.h>

#include "cli/progress_bar.h"

namespace reprise::cli {
namespace {

TEST(Text, SizesHaveReadableUnits) {
  EXPECT_EQ(format_size(0), "0 B");
  EXPECT_EQ(format_size(999), "999 B");
  EXPECT_EQ(format_size(1000), "1.0 kB");
  EXPECT_EQ(format_size(13'580'000), "13.6 MB");
  EXPECT_EQ(format_size(999'960), "1.0 MB");
  EXPECT_EQ(format_size(UINT64_MAX), "18.4 EB");
}

TEST(Text, RatiosHaveOneDecimal) {
  EXPECT_EQ(format_ratio(1234, 10), "123.4:1");
  EXPECT_EQ(format_ratio(0, 10), "-");
  EXPECT_EQ(format_ratio(10, 0), "-");
}

TEST(Text, ClockRoundsToSeconds) {
  EXPECT_EQ(format_clock(0.4), "0:00");
  EXPECT_EQ(format_clock(59.6), "1:00");
  EXPECT_EQ(format_clock(3723), "1:02:03");
}

TEST(Text, ControlCharactersDoNotReachTheTerminal) {
  EXPECT_EQ(printable("a\033[31mb\nc"), "a?[31mb?c");
  EXPECT_EQ(printable("Bär"), "Bär");
}

TEST(Text, TableAlignsByCharactersNotBytes) {
  Table table({{"NAME", Table::Align::left}, {"N", Table::Align::right}});
  table.add({"Bär", "1"});
  table.add({"Bear", "22"});
  EXPECT_EQ(table.text(), "NAME   N\nBär    1\nBear  22\n");
}

TEST(Text, TableWithoutHeadingsHasNoLineForThem) {
  Table table({{"", Table::Align::left}, {"", Table::Align::left}});
  table.add({"a", ""});
  EXPECT_EQ(table.text(true), "a\n");
}

TEST(Progress, LineSaysShareAndTimeLeft) {
  const std::string line = progress_line("ingest", {6, 24, "walk/03"}, 10.0, 200);
  EXPECT_NE(line.find("25 %"), std::string::npos);
  EXPECT_NE(line.find("6/24"), std::string::npos);
  EXPECT_NE(line.find("0:30 left"), std::string::npos);
  EXPECT_NE(line.find("walk/03"), std::string::npos);
}

TEST(Progress, LineIsNeverWiderThanTheTerminal) {
  EXPECT_EQ(progress_line("ingest", {1, 2, std::string(300, 'x')}, 1.0, 79).size(), 79U);
  EXPECT_NE(progress_line("verify", {0, 0, ""}, 0.0, 79).find("0 %"), std::string::npos);
}

}  // namespace
}  // namespace reprise::cli
