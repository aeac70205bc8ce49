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

TEST(KeptArchive, IsWhole) {
  for (const char* name : {"standard.rpz", "exact.rpz"}) {
    const VerifyReport report = Archive(kept / name).verify();
    EXPECT_TRUE(report.ok) << name;
    EXPECT_EQ(report.takes, 3u) << name;
    EXPECT_EQ(report.clips, 3u) << name;
  }
}

TEST(KeptArchive, HasTheContentDigestThatItHad) {
  EXPECT_EQ(Archive(kept / "standard.rpz").info().content_digest,
            "f1274ba22afc3d31ae5d856c6e47e1c2");
  EXPECT_EQ(Archive(kept / "exact.rpz").info().content_digest, "c05cadce700cfa9f23d8ffee237e7be5");
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
  const Archive exact(kept / "exact.rpz"), standard(kept / "standard.rpz");
  for (const TakeInfo& info : exact.takes()) {
    const Take source = exact.extract(info);
    const auto mean = [&](const Archive& archive) {
      const Take curves = archive.extract(archive.find_take(info.name), FidelityTier::preview);
      return compare_takes(source, curves).errors.mean;
    };
    EXPECT_LE(mean(exact), FidelityLimits::preview_mean_mm) << info.name;
    EXPECT_LE(mean(standard), FidelityLimits::preview_mean_mm) << info.name;
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
