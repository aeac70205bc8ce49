// Recordings that do not hold what they say: what is taken, what only with `partial`, and what is
// told of it.
#include <gtest/gtest.h>

#include <functional>

#include "formats/samples.h"
#include "reprise/error.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

/// A chain of `joints` with a channel each.
std::string chain_hierarchy(int joints) {
  std::string text = "HIERARCHY\n", end;
  for (int j = 0; j < joints; ++j) {
    text += (j == 0 ? "ROOT j" : "JOINT j") + std::to_string(j) +
            "\n{\nOFFSET 0 1 0\nCHANNELS 1 Zrotation\n";
    end += "}\n";
  }
  return text + end;
}

std::string row(int joints, int frame) {
  std::string text;
  for (int j = 0; j < joints; ++j) {
    if (j > 0) text += ' ';
    text += std::to_string(frame) + "." + std::to_string(j + 1);
  }
  return text;
}

std::string bvh(int joints, long claimed, int rows, const std::string& rest = "") {
  std::string text = chain_hierarchy(joints) + "MOTION\nFrames: " + std::to_string(claimed) +
                     "\nFrame Time: 0.02\n";
  for (int f = 0; f < rows; ++f) text += row(joints, f) + "\n";
  return text + rest;
}

Take read(const std::string& text, bool partial = false) {
  return read_bvh(text, "a.bvh", default_millimetres_per_unit, std::nullopt, partial);
}

Error error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "it was taken";
  return Error(ErrorCode::failed, "nothing was thrown");
}

TEST(CutOff, MoreRowsThanSaidAreTakenAndTold) {
  for (const int joints : {1, 3}) {
    for (const int rows : {1, 2, 7}) {
      for (const long claimed : {0L, rows - 1L}) {
        for (const bool partial : {false, true}) {
          const Take take = read(bvh(joints, claimed, rows), partial);
          EXPECT_EQ(take.frames(), rows);
          EXPECT_EQ(take.channels(rows - 1, 0), rows - 1 + 0.1);
          ASSERT_EQ(take.notes.size(), 1U);
          EXPECT_EQ(take.notes[0].line, static_cast<std::size_t>(3 + 5 * joints));
          EXPECT_EQ(take.notes[0].what, "'Frames:' says " + std::to_string(claimed) + "; the " +
                                            std::to_string(rows) + " that are there were taken");
          EXPECT_NE(write_bvh(take).find("Frames: " + std::to_string(rows) + "\n"),
                    std::string::npos);
        }
      }
    }
  }
}

TEST(CutOff, AsManyRowsAsSaidAreNothingToTell) {
  EXPECT_TRUE(read(bvh(2, 3, 3)).notes.empty());
  EXPECT_TRUE(read(bvh(2, 3, 2, row(2, 2))).notes.empty());  // without a last line end
  EXPECT_TRUE(read(bvh(2, 3, 3), true).notes.empty());
}

TEST(CutOff, FewerRowsThanSaidAreTakenOnlyInPart) {
  for (const long claimed : {4L, 1'000'000'000'000L}) {
    const std::string text = bvh(2, claimed, 3);
    const Error error = error_of([&] { read(text); });
    EXPECT_EQ(error.code(), ErrorCode::rejected_input);
    EXPECT_EQ(error.reason(), "'Frames:' says " + std::to_string(claimed) + ", but there are 3");
    EXPECT_NE(error.advice().find("--partial"), std::string::npos);
    const Take take = read(text, true);
    EXPECT_EQ(take.frames(), 3);
    EXPECT_EQ(take.notes.size(), 1U);
  }
}

TEST(CutOff, ALastRowThatIsCutIsLeftOut) {
  const std::string whole = row(3, 3);
  for (std::size_t length = 1; length < whole.size(); ++length) {
    for (const long claimed : {3L, 4L, 9L}) {
      const std::string text = bvh(3, claimed, 3, whole.substr(0, length));
      SCOPED_TRACE(text.substr(text.find("Time")));
      const bool whole_row = length > whole.rfind(' ') + 1;
      if (!whole_row || claimed == 9) {
        EXPECT_NE(error_of([&] { read(text); }).advice().find("--partial"), std::string::npos);
      }
      const Take take = read(text, true);
      // Three numbers may be whole, and are where so many frames are said to be there.
      EXPECT_EQ(take.frames(), whole_row && claimed <= 4 ? 4 : 3);
      EXPECT_EQ(take.channels(2, 2), 2.3);
    }
  }
}

TEST(CutOff, AWordThatIsHalfANumberIsACut) {
  for (const char* rest : {"3.1 -", "3.1 4.", "3.1 1e", "3.1 1e-", "+"}) {
    EXPECT_EQ(read(bvh(3, 5, 3, rest), true).frames(), 3) << rest;
  }
  // A fault is one where the line goes on.
  EXPECT_THROW(read(bvh(3, 5, 3, "3.1 - 3\n"), true), Error);
  EXPECT_THROW(read(bvh(3, 5, 3, "3.1 x\n"), true), Error);
}

TEST(CutOff, ARowThatIsNotTheLastIsAFault) {
  for (const bool partial : {false, true}) {
    const std::string text = bvh(3, 5, 2, "1.1 1.2\n" + row(3, 4) + "\n");
    const Error error = error_of([&] { read(text, partial); });
    EXPECT_EQ(error.place().line, 22U);
    EXPECT_EQ(error.reason(), "a frame has 2 numbers where the hierarchy has 3 channels");
    EXPECT_EQ(error.advice().find("--partial"), std::string::npos);
    EXPECT_THROW(read(bvh(3, 5, 2, "1 2 3 4\n"), partial), Error);
  }
}

TEST(CutOff, NothingIsNoRecording) {
  EXPECT_EQ(read(bvh(2, 5, 0), true).frames(), 0);
  EXPECT_EQ(read(bvh(2, 0, 0)).frames(), 0);
  EXPECT_THROW(read(bvh(2, 5, 0)), Error);
}

// What decides how much memory is taken is what is there, not how many lines there are.
TEST(CutOff, ManyShortLinesTakeNoMemoryForWholeFrames) {
  std::string text = chain_hierarchy(200) + "MOTION\nFrames: 5\nFrame Time: 0.02\n";
  text += row(200, 0) + "\n";
  for (int i = 0; i < 2'000'000; ++i) text += "1\n";
  EXPECT_THROW(read(text, true), Error);
}

Take read_amc_text(const std::string& text, bool partial) {
  return read_amc(text, "a.amc", std::make_shared<Skeleton>(read_asf(plain_asf(), "s.asf")),
                  std::nullopt, partial);
}

TEST(CutOff, AnAmcIsTakenUpToItsLastWholeFrame) {
  const std::string frame = "\nroot 1 2 3 4 5 6\ntibia .5 -1 2\nfemur 1 2 3\n";
  const std::string three = "1" + frame + "2" + frame + "3" + frame;
  ASSERT_EQ(read_amc_text(three, false).frames(), 3);
  const std::size_t second = ("1" + frame + "2" + frame).size();
  const std::size_t last_value = three.size() - 2;
  for (std::size_t length = second + 1; length < last_value; ++length) {
    const std::string text = three.substr(0, length);
    SCOPED_TRACE(text.substr(second));
    EXPECT_NE(error_of([&] { read_amc_text(text, false); }).advice().find("--partial"),
              std::string::npos);
    const Take take = read_amc_text(text, true);
    EXPECT_EQ(take.frames(), 2);
    EXPECT_EQ(take.notes.size(), 1U);
  }
}

TEST(CutOff, AnAmcWithAFaultBeforeItsEndIsRejected) {
  const std::string frame = "\nroot 1 2 3 4 5 6\ntibia .5 -1 2\nfemur 1 2 3\n";
  for (const std::string& fault :
       {"2\nroot 1 2 3 4 5 6\ntibia .5 -1 2\n3" + frame, "2\nroot 1 2 3 4 5\n3" + frame,
        "2\nroot 1 2 3 4 5 6\nfibula 1 2 3\n3" + frame, "3" + frame,
        std::string("2\nroot 1 2 3 4 5 6 7\n"), "2" + frame + "END\n", "2" + frame + "rem",
        std::string("2\nroot 1 2 3 4 5 6\nfem")}) {
    EXPECT_THROW(read_amc_text("1" + frame + fault, true), Error) << fault;
  }
}

}  // namespace
}  // namespace reprise
