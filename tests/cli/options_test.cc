#include "cli/options.h"

#include <gtest/gtest.h>

#include "cli/ingest_command.h"
#include "cli/intervals.h"
#include "reprise/error.h"

namespace reprise::cli {
namespace {

template <typename Action>
ErrorCode code_of(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "no error";
  return ErrorCode::failed;
}

TEST(Options, NumbersAreReadWhole) {
  EXPECT_EQ(parse_number("--x", "2.5", 0, 10), 2.5);
  EXPECT_EQ(parse_number("--x", "1e1", 0, 10), 10);
  EXPECT_EQ(parse_whole_number("--n", "18446744073709551615", 0, UINT64_MAX), UINT64_MAX);
  for (const char* bad : {"", "2,5", "2.5mm", " 2", "0x2", "nan", "inf", "11", "-1"}) {
    EXPECT_EQ(code_of([&] { parse_number("--x", bad, 0, 10); }), ErrorCode::usage) << bad;
  }
  for (const char* bad : {"", "2.0", "-1", "+1", "18446744073709551616", "two"}) {
    EXPECT_EQ(code_of([&] { parse_whole_number("--n", bad, 0, UINT64_MAX); }), ErrorCode::usage)
        << bad;
  }
}

TEST(Options, IntervalsMayLackASide) {
  EXPECT_EQ(parse_frame_interval("--frames", "3:7").begin, 3);
  EXPECT_EQ(parse_frame_interval("--frames", "3:7").end, 7);
  EXPECT_FALSE(parse_frame_interval("--frames", ":7").begin);
  EXPECT_FALSE(parse_frame_interval("--frames", "3:").end);
  EXPECT_EQ(parse_time_interval("--time", "0.5:1.25").end, 1.25);
  for (const char* bad : {"", ":", "3", "7:3", "3:3", ":0", "a:b", "-1:3", "1:2:3", "1.5:2"}) {
    EXPECT_EQ(code_of([&] { parse_frame_interval("--frames", bad); }), ErrorCode::usage) << bad;
  }
  EXPECT_EQ(code_of([] { parse_time_interval("--time", "nan:1"); }), ErrorCode::usage);
}

TEST(Options, FramesAreHalfOpenAndInsideTheWhole) {
  const FrameRange whole{10, 50};
  const FrameRange open = frames_of(Interval<long>{20, {}}, whole);
  EXPECT_EQ(open.begin, 20);
  EXPECT_EQ(open.end, 50);
  EXPECT_EQ(code_of([&] { frames_of(Interval<long>{0, 20}, whole); }), ErrorCode::usage);
  EXPECT_EQ(code_of([&] { frames_of(Interval<long>{20, 51}, whole); }), ErrorCode::usage);
}

TEST(Options, TimesNameTheFramesWithinThem) {
  // Frame i is at i / 30 s. 0.1 * 30 is above 3 in binary; frame 3 is meant all the same.
  const FrameRange range = frames_of(Interval<double>{0.1, 0.21}, FrameRange{0, 100}, 30);
  EXPECT_EQ(range.begin, 3);
  EXPECT_EQ(range.end, 7);
  const double rate = 1 / 0.0083333;
  const FrameRange all = frames_of(Interval<double>{0.0, 100 / rate}, FrameRange{0, 100}, rate);
  EXPECT_EQ(all.begin, 0);
  EXPECT_EQ(all.end, 100);
}

TEST(Options, TimesWithoutAFrameAreToldInSeconds) {
  const auto told = [](Interval<double> interval) -> std::string {
    try {
      frames_of(interval, FrameRange{0, 100}, 30);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::usage);
      return error.reason();
    }
    return "no error";
  };
  EXPECT_EQ(told({300.0, {}}).rfind("300: s are not within 0:3.33333 s", 0), 0U);
  EXPECT_EQ(told({{}, 4.0}).rfind(":4 s are not within 0:3.33333 s", 0), 0U);
  EXPECT_EQ(told({0.01, 0.02}).rfind("no frame is within 0.01:0.02 s", 0), 0U);
}

TEST(Options, CheckingTouchesNoFile) {
  IngestCommand command;
  CLI::App app;
  command.setup(app);
  app.parse("/nowhere/lib.rpz /nowhere/takes --metadata /nowhere/takes.csv");
  EXPECT_NO_THROW(command.check());
}

}  // namespace
}  // namespace reprise::cli
