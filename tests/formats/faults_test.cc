// Faults of everyday files: each has one sentence with its line, and advice; and what looks like a
// fault and is none.
#include <gtest/gtest.h>

#include <functional>

#include "formats/samples.h"
#include "formats/text_lines.h"
#include "reprise/error.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

void expect_rejected(const std::string& text, std::size_t line, const std::string& why,
                     const std::string& advice) {
  try {
    read_bvh(text, "a.bvh");
    ADD_FAILURE() << "it was taken: " << why;
  } catch (const Error& error) {
    EXPECT_EQ(error.place().line, line);
    EXPECT_EQ(error.reason(), why);
    EXPECT_NE(error.advice().find(advice), std::string::npos) << error.advice();
  }
}

TEST(Faults, NumbersThatAreGluedTogether) {
  for (const char* glued :
       {"1.5-2.3", "-12.25-0.5", "1-2", "12.345.678", "1e-3-4", "0.5+1", "-1.-2.-3."}) {
    expect_rejected(replaced(plain_bvh(), "-179.5", glued), 24,
                    std::string("two numbers stand together without a space: '") + glued + "'",
                    "space");
  }
  for (const char* other : {"--1", "1-", "-", "nan", "1.2.x", "0x10", "1,x"}) {
    EXPECT_EQ(number_fault(other).why, std::string("this is not a number: '") + other + "'");
  }
}

TEST(Faults, Commas) {
  for (const char* comma : {"1,5", "-0,25", "12,5e-3"}) {
    expect_rejected(replaced(plain_bvh(), "-179.5", comma), 24,
                    std::string("a decimal comma stands where a point should: '") + comma + "'",
                    "decimal points");
  }
  for (const char* parted : {"1.5,2.5", "1,2,3", "1.5,"}) {
    expect_rejected(replaced(plain_bvh(), "-179.5", parted), 24,
                    std::string("numbers are parted by commas: '") + parted + "'", "spaces");
  }
}

TEST(Faults, ScaleChannels) {
  for (const char* scale : {"Xscale", "yScale", "ZSCALE"}) {
    for (const char* count : {"4", "9"}) {
      const std::string channels =
          std::string("CHANNELS ") + count + " Zrotation Yrotation " + scale + " Xrotation";
      expect_rejected(
          replaced(plain_bvh(), "CHANNELS 3 Zrotation Yrotation Xrotation", channels), 9,
          std::string("the channel '") + scale + "' scales its joint, which is not read",
          "without scale channels");
    }
  }
}

TEST(Faults, SecondRootAndMissingMotion) {
  const std::string text = plain_bvh();
  expect_rejected(replaced(text, "MOTION", "ROOT other\n{\n}\nMOTION"), 21,
                  "there is a second ROOT", "own file");
  expect_rejected(replaced(text, "MOTION\n", ""), 21, "the line MOTION is missing before 'Frames:'",
                  "in front");
  expect_rejected(text.substr(0, text.find("MOTION")), 20, "the file ends before MOTION",
                  "skeleton alone");
  expect_rejected(text.substr(0, text.find("JOINT empty")), 15, "the file ends before MOTION",
                  "cut off");
}

TEST(Faults, EveryRejectionHasAdvice) {
  for (const char* text : {"", "x", "HIERARCHY\n}", "HIERARCHY\nROOT a\n{\nCHANNELS 7\n",
                           "HIERARCHY\nROOT a\n{\nOFFSET 1 2\n"}) {
    try {
      read_bvh(text, "a.bvh");
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_NE(error.advice(), "") << error.what();
    }
  }
}

TEST(Faults, TheHierarchyMayBeginOnItsFirstLine) {
  const Take usual = read_bvh(plain_bvh(), "a.bvh");
  for (const char* between : {" ", "\t", "   "}) {
    const Take take =
        read_bvh(replaced(plain_bvh(), "HIERARCHY\n", "HIERARCHY" + std::string(between)), "a.bvh");
    EXPECT_TRUE(same_structure(*take.skeleton, *usual.skeleton));
    EXPECT_EQ(take.channels, usual.channels);
    EXPECT_EQ(read_bvh(write_bvh(take), "b.bvh").channels, take.channels);
  }
}

// The second byte of a character of Shift-JIS, GBK or Big5 may be that of a brace.
TEST(Faults, NamesAreNotCutWithinACharacter) {
  const std::string bone = "\x83\x7B\x81\x5B\x83\x93";  // "bone" in Shift-JIS
  for (const std::string& name :
       {bone, bone + " 2", "j" + bone, bone + "\x83\x7B", std::string("\x83\x7B"),
        std::string("\xC4\x7B\xB9\xC7"), "\xB6" + bone}) {
    for (const char* brace : {"\n\t{", "\n\n{", " {\n", "\t{ "}) {
      const std::string text =
          replaced(plain_bvh(), "JOINT Left Up Leg\n\t{", "JOINT " + name + brace);
      const Take take = read_bvh(text, "a.bvh");
      EXPECT_EQ(take.skeleton->joints[1].name, name);
      EXPECT_EQ(take.skeleton->joints.size(), 4U);
      EXPECT_NE(write_bvh(take).find("JOINT " + name + brace), std::string::npos);
    }
  }
}

TEST(Faults, ABraceBehindANameIsABrace) {
  for (const std::string& name :
       {std::string("Leg"),
        std::string("H\xC3\xBC"
                    "fte"),
        std::string("\xE9\xAA\xA8"), std::string("\x83\x7B\x81\x5B\x83\x93")}) {
    for (const char* brace : {"{\n", "{ ", "{\r\n\t"}) {
      const std::string text = replaced(plain_bvh(), "JOINT Left Up Leg\n\t{\n\t\tOFFSET",
                                        "JOINT " + name + brace + "OFFSET");
      EXPECT_EQ(read_bvh(text, "a.bvh").skeleton->joints[1].name, name) << brace;
    }
  }
}

TEST(Faults, AnglesOfAnAsfHoldForAmcFilesThatSayNothing) {
  const std::string radians = replaced(plain_asf(), "angle deg", "angle rad");
  const auto skeleton = std::make_shared<Skeleton>(read_asf(radians, "s.asf"));
  const std::string silent = replaced(plain_amc(), ":DEGREES\n", "");
  const Take take = read_amc(silent, "s.amc", skeleton);
  EXPECT_TRUE(take.layout.radians);
  EXPECT_NEAR(take.channels(0, 3), 4 * 57.29577951308232, 1e-9);
  EXPECT_NEAR(
      (read_amc(write_amc(take), "t.amc", skeleton).channels - take.channels).cwiseAbs().maxCoeff(),
      0, 1e-6);
  // A keyword of the AMC comes before it.
  EXPECT_EQ(read_amc(plain_amc(), "s.amc", skeleton).channels(0, 3), 4.0);
  const auto degrees = std::make_shared<Skeleton>(read_asf(plain_asf(), "s.asf"));
  EXPECT_EQ(read_amc(silent, "s.amc", degrees).channels(0, 3), 4.0);
}

TEST(Faults, ARateThatIsGivenComesBeforeTheFilesOwn) {
  for (const char* said : {"0.0416667", "0", "33.3", "-1", "soon"}) {
    for (const double rate : {120.0, 59.94, 10.0 / 3}) {
      const Take take = read_bvh(replaced(plain_bvh(), "0.0083333", said), "a.bvh", 10.0, rate);
      EXPECT_EQ(take.frame_rate, rate);
      EXPECT_FALSE(take.frame_rate_assumed);
      EXPECT_NEAR(read_bvh(write_bvh(take), "b.bvh").frame_rate / rate, 1, 1e-12);
    }
  }
  for (const double rate : {0.0, 0.5}) {
    EXPECT_THROW(read_bvh(plain_bvh(), "a.bvh", 10.0, rate), Error) << rate;
  }
}

/// plain_amc with a value for each turn of each bone that moves.
std::string all_turns_amc(const std::string& keyword) {
  return keyword + ":DEGREES\n1\nroot 1 2 3 4 5 6\nfemur 1 2 3\ntibia .5 10 2 20 30\nhand 7 8 9\n";
}

TEST(Faults, BonesMayHaveValuesForAllTurns) {
  const auto skeleton = std::make_shared<Skeleton>(read_asf(plain_asf(), "s.asf"));
  EXPECT_THROW(read_amc(all_turns_amc(""), "a.amc", skeleton), Error);
  const std::string text = all_turns_amc(":FORCE-ALL-JOINTS-BE-3DOF\n");
  const Take take = read_amc(text, "a.amc", skeleton);
  ASSERT_EQ(take.channels.cols(), 6 + 3 + 5 + 3);
  const auto& joints = take.skeleton->joints;
  // What a bone lacks comes behind its own, in the order of the axes.
  const auto joint_named = [&](const char* name) {
    return *std::ranges::find(joints, name, &Joint::name);
  };
  using enum Channel;
  EXPECT_EQ(joint_named("tibia").channels,
            (std::vector<Channel>{x_position, z_rotation, length, x_rotation, y_rotation}));
  EXPECT_EQ(joint_named("hand").channels,
            (std::vector<Channel>{x_rotation, y_rotation, z_rotation}));
  EXPECT_TRUE(joint_named("toes").channels.empty());
  // The order of turns is that of the bone's axes.
  EXPECT_EQ(joint_named("tibia").rotation_order, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(joint_named("hand").rotation_order, (std::vector<int>{2, 1, 0}));
  const Take again = read_amc(write_amc(take), "b.amc", skeleton);
  EXPECT_EQ(again.channels, take.channels);
  EXPECT_EQ(read_amc(write_amc(take), "b.amc", take.skeleton).channels, take.channels);
  EXPECT_TRUE(amc_has_all_turns(take.layout.amc_header));
  EXPECT_FALSE(amc_has_all_turns("# :FORCE-ALL-JOINTS-BE-3DOF\n:DEGREES\n"));
}

}  // namespace
}  // namespace reprise
