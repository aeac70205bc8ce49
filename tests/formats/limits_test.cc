// What is beyond a limit is rejected with a sentence that names it; what is at it is taken.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "formats/samples.h"
#include "reprise/error.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

/// The sentence of the error, with its line in front; empty where there is none.
std::string rejection(const std::function<void()>& read) {
  try {
    read();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::rejected_input);
    return std::to_string(error.place().line) + ": " + error.reason();
  }
  return "";
}

std::string rejection_of_bvh(const std::string& text) {
  return rejection([&] { read_bvh(text, "a.bvh"); });
}

/// A chain of joints, `depth` of them.
std::string chain(std::size_t depth) {
  std::string text = "HIERARCHY\n";
  for (std::size_t i = 0; i < depth; ++i) {
    text += i == 0 ? "ROOT a\n{\nCHANNELS 1 Zrotation\n" : "JOINT b\n{\n";
  }
  for (std::size_t i = 0; i < depth; ++i) text += "}\n";
  return text + "MOTION\nFrames: 1\nFrame Time: 0.01\n0\n";
}

/// A root with `children`, each with `channels`.
std::string star(std::size_t children, const std::string& channels) {
  std::string text = "HIERARCHY\nROOT a\n{\nCHANNELS 1 Zrotation\n";
  for (std::size_t i = 0; i < children; ++i) text += "JOINT b { " + channels + " }\n";
  return text + "}\nMOTION\nFrames: 0\nFrame Time: 0.01\n";
}

std::string named(const std::string& name) {
  return "HIERARCHY\nROOT " + name +
         "\n{\nCHANNELS 1 Zrotation\n}\nMOTION\nFrames: 1\nFrame Time: 0.01\n0\n";
}

std::string with_number(const std::string& number) {
  return "HIERARCHY\nROOT a\n{\nCHANNELS 1 Zrotation\n}\nMOTION\nFrames: 1\nFrame Time: 0.01\n" +
         number + "\n";
}

TEST(Limits, Depth) {
  EXPECT_EQ(rejection_of_bvh(chain(InputLimits::depth)), "");
  EXPECT_NE(rejection_of_bvh(chain(InputLimits::depth + 1)).find("deeper than 256"),
            std::string::npos);
  EXPECT_NE(rejection_of_bvh(chain(100000)).find("deeper than 256"), std::string::npos);
}

TEST(Limits, Joints) {
  EXPECT_EQ(rejection_of_bvh(star(InputLimits::joints - 1, "")), "");
  EXPECT_EQ(rejection_of_bvh(star(InputLimits::joints, "")),
            "4100: there are more than 4096 joints");
}

TEST(Limits, Channels) {
  const std::string six = "CHANNELS 6 Xposition Yposition Zposition Xrotation Yrotation Zrotation";
  EXPECT_EQ(rejection_of_bvh(star(2730, six)), "");
  EXPECT_NE(rejection_of_bvh(star(2731, six)).find("more than 16384 channels"), std::string::npos);
}

TEST(Limits, NamesAndNumbers) {
  EXPECT_EQ(rejection_of_bvh(named(std::string(InputLimits::name_bytes, 'n'))), "");
  EXPECT_EQ(rejection_of_bvh(named(std::string(InputLimits::name_bytes + 1, 'n'))),
            "2: a name is longer than 1024 bytes");
  EXPECT_EQ(rejection_of_bvh(with_number(std::string(InputLimits::number_bytes, '0'))), "");
  EXPECT_NE(rejection_of_bvh(with_number(std::string(InputLimits::number_bytes + 1, '0')))
                .find("9: a number is longer than 64 bytes"),
            std::string::npos);
  EXPECT_EQ(rejection_of_bvh(with_number("-1e9")), "");
  EXPECT_EQ(rejection_of_bvh(with_number("1.1e9")), "9: a number is beyond 1000000000: '1.1e9'");
}

TEST(Limits, Lines) {
  const std::string blanks(InputLimits::line_bytes, ' ');
  EXPECT_EQ(rejection_of_bvh(blanks.substr(1) + "\n" + named("a")), "");
  EXPECT_EQ(rejection_of_bvh(blanks + " \n" + named("a")),
            "1: a line is longer than 16777216 bytes");
}

TEST(Limits, NulBytes) {
  EXPECT_EQ(rejection_of_bvh(named(std::string("a\0b", 3))),
            "2: there is a NUL byte; this is not a text file");
}

TEST(Limits, ClaimsTakeNoMemory) {
  std::string text = with_number("0");
  text.replace(text.find("Frames: 1"), 9, "Frames: 1000000000000");
  EXPECT_EQ(rejection_of_bvh(text), "9: 'Frames:' says 1000000000000, but there are 1");
  text.replace(text.find("1000000000000"), 13, "99999999999999999999");
  EXPECT_EQ(rejection_of_bvh(text).substr(0, 2), "7:");
}

TEST(Limits, StatementsOnALineNeedNoStack) {
  std::string text = "HIERARCHY\nROOT a\n{\n";
  for (int i = 0; i < 1000000; ++i) text += "OFFSET 0 0 0 ";
  text += "CHANNELS 1 Zrotation }\nMOTION\nFrames: 0\nFrame Time: 0.01\n";
  EXPECT_EQ(rejection_of_bvh(text), "");
}

// Of an AMC's bones a few may be missing, but a few bytes a frame must not claim a row of memory.
TEST(Limits, FramesGiveAShareOfTheirSkeleton) {
  std::string asf = ":root\norder TX\n:bonedata\n", tree = ":hierarchy\nbegin\nroot";
  for (int b = 0; b < 11; ++b) {
    const std::string name = " b" + std::to_string(b);
    asf += "begin\nname" + name + "\ndirection 0 1 0\nlength 1\ndof rx ry rz\nend\n";
    tree += name;
  }
  const auto skeleton = std::make_shared<Skeleton>(read_asf(asf + tree + "\nend\n", "a.asf"));
  ASSERT_EQ(skeleton->channel_count, 34);
  const auto read = [&](const std::string& text) {
    return rejection([&] { read_amc(text, "a.amc", skeleton); });
  };
  EXPECT_EQ(read("1\nb0 1 2 3\n2\nb0 1 2 3\n"), "");
  EXPECT_EQ(read("1\nroot 1\n2\nroot 2\n"),
            "3: the first frame gives 1 of its skeleton's 34 values, less than one in 16");
  EXPECT_NE(read("1\n2\n3\n"), "");
}

TEST(Limits, FrameNumbersDoNotOverflow) {
  const auto skeleton = std::make_shared<Skeleton>(read_asf(plain_asf(), "s.asf"));
  std::string text = plain_amc();
  text.replace(text.find("\n7\n"), 3, "\n9223372036854775807\n");
  EXPECT_EQ(rejection([&] { read_amc(text, "a.amc", skeleton); }),
            "4: frame numbers end at 1000000000000");
}

TEST(FrameRates, OfAMotionAreNeitherNothingNorEndless) {
  const auto skeleton = std::make_shared<const Skeleton>(read_asf(plain_asf(), "a.asf"));
  for (const double rate : {0.0, -1.0, 1e300, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(read_amc(plain_amc(), "a.amc", skeleton, rate), Error) << rate;
  EXPECT_EQ(read_amc(plain_amc(), "a.amc", skeleton, 25.0).frame_rate, 25.0);
}

}  // namespace
}  // namespace reprise
