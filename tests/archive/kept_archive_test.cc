// Archives that were written once still say the same. Whatever is changed on the side of the writer
// and of the reader at once, and passes every round trip, fails here.
#include <gtest/gtest.h>

#include "reprise/archive.h"
#include "reprise/formats/motion_file.h"
#include "reprise/model/measure.h"

namespace reprise {
namespace {

const std::filesystem::path kept = REPRISE_KEPT_ARCHIVES;

/// What is measured must be what was measured when they were written, but for another machine's
/// arithmetic (mm).
constexpr double other_arithmetic = 0.01;

struct Kept {
  const char* file;
  std::size_t takes, clips;
  const char* content_digest;
};
constexpr Kept archives[] = {
    {"standard.rpz", 3, 3, "295b187b1f6a1edf368152c1464c0584"},
    {"exact.rpz", 3, 3, "eb012cfa69a9bf0a0955f4457daa605e"},
    {"library.rpz", 16, 65,
     "6ac6ddd98fd71fb6bf89ddbb7ba5b1f9"},  // its spaces have learned, and clips repeat others
};

TEST(KeptArchive, IsWhole) {
  for (const Kept& one : archives) {
    const VerifyReport report = Archive(kept / one.file).verify();
    EXPECT_TRUE(report.ok) << one.file;
    EXPECT_EQ(report.takes, one.takes) << one.file;
    EXPECT_EQ(report.clips, one.clips) << one.file;
  }
}

TEST(KeptArchive, HasTheContentDigestThatItHad) {
  for (const Kept& one : archives)
    EXPECT_EQ(Archive(kept / one.file).info().content_digest, one.content_digest) << one.file;
}

TEST(KeptArchive, RefinementsAreAsFarFromTheirSourcesAsTheyWere) {
  const Archive exact(kept / "exact.rpz"), standard(kept / "standard.rpz");
  for (const TakeInfo& info : standard.takes()) {
    const Take source = exact.extract(exact.find_take(info.name));
    const PositionErrors errors = compare_takes(source, standard.extract(info)).errors;
    EXPECT_NEAR(errors.max, info.error_mm.max, other_arithmetic) << info.name;
    EXPECT_NEAR(errors.mean, info.error_mm.mean, other_arithmetic) << info.name;
  }
}

TEST(KeptArchive, CurvesAreWithinTheMeanThatTheyPromised) {
  const Archive exact(kept / "exact.rpz");
  for (const TakeInfo& info : exact.takes()) {
    const Take curves = exact.extract(info, FidelityTier::preview);
    EXPECT_LE(compare_takes(exact.extract(info), curves).errors.mean,
              FidelityLimits::preview_mean_mm)
        << info.name;
  }
  const Archive library(kept / "library.rpz");
  for (const TakeInfo& info : library.takes()) {
    const Take curves = library.extract(info, FidelityTier::preview);
    // Both are off.
    EXPECT_LE(compare_takes(library.extract(info), curves).errors.mean,
              FidelityLimits::preview_mean_mm + info.error_mm.mean)
        << info.name;
  }
}

TEST(KeptArchive, TextsAreMotionFiles) {
  const Archive exact(kept / "exact.rpz");
  for (const TakeInfo& info : exact.takes()) {
    const std::string text = exact.source_text(info);
    EXPECT_EQ(text.size(), info.text_bytes) << info.name;
    const Take take = info.format == MotionFormat::bvh
                          ? read_bvh(text, info.name)
                          : read_amc(text, info.name, exact.skeleton(info));
    EXPECT_EQ(take.frames(), info.frames) << info.name;
  }
}

}  // namespace
}  // namespace reprise
