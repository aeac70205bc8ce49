// What is written is what was read, and no text does harm.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <random>

#include "formats/samples.h"
#include "reprise/error.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

void expect_same(const Take& one, const Take& two, double tolerance) {
  EXPECT_TRUE(same_structure(*one.skeleton, *two.skeleton));
  ASSERT_EQ(one.skeleton->joints.size(), two.skeleton->joints.size());
  for (std::size_t j = 0; j < one.skeleton->joints.size(); ++j) {
    EXPECT_EQ(one.skeleton->joints[j].name, two.skeleton->joints[j].name);
    EXPECT_EQ(one.skeleton->joints[j].offset, two.skeleton->joints[j].offset);
    EXPECT_EQ(one.skeleton->joints[j].parent, two.skeleton->joints[j].parent);
  }
  EXPECT_EQ(one.layout.frame_time_text, two.layout.frame_time_text);
  EXPECT_EQ(one.layout.amc_joints, two.layout.amc_joints);
  EXPECT_EQ(one.layout.first_frame_number, two.layout.first_frame_number);
  ASSERT_EQ(one.channels.rows(), two.channels.rows());
  ASSERT_EQ(one.channels.cols(), two.channels.cols());
  EXPECT_LT((one.channels - two.channels).cwiseAbs().maxCoeff(), tolerance);
}

Take read_sample(const Sample& sample, const std::string& motion) {
  if (sample.skeleton.empty()) return read_bvh(motion, "sample.bvh");
  return read_amc(motion, "sample.amc",
                  std::make_shared<Skeleton>(read_asf(sample.skeleton, "sample.asf")));
}

TEST(RoundTrip, SamplesComeBack) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    const Take take = read_sample(sample, sample.motion);
    const std::string written = write_motion(take);
    const Take again = read_sample(sample, written);
    // Half of the last digit, which of radians is more degrees.
    expect_same(take, again, take.layout.radians ? 1e-6 * 180 / 3.14159 : 1e-6);
    EXPECT_EQ(write_motion(again), written);
  }
}

TEST(RoundTrip, SkeletonTextGivesTheSkeletonAgain) {
  for (const Sample& sample : samples()) {
    if (!sample.skeleton.empty()) continue;
    const Take take = read_sample(sample, sample.motion);
    EXPECT_TRUE(same_structure(*take.skeleton, read_bvh_skeleton(take.skeleton->source_text, "s")));
  }
}

TEST(RoundTrip, RealTakesComeBack) {
  const char* data = std::getenv("REPRISE_DATA");
  if (data == nullptr || !fs::exists(data))
    GTEST_SKIP() << "REPRISE_DATA names no folder of real takes";
  std::size_t seen = 0, read = 0;
  for (const auto& entry : fs::recursive_directory_iterator(data)) {
    if (!is_motion_file(entry.path()) || seen++ % 97 != 0) continue;
    SCOPED_TRACE(entry.path());
    const Take take = read_motion_file(entry.path());
    const std::string written = write_motion(take);
    const Take again = take.skeleton->format == MotionFormat::bvh
                           ? read_bvh(written, "again.bvh")
                           : read_amc(written, "again.amc", take.skeleton);
    expect_same(take, again, 1e-6);
    ++read;
  }
  EXPECT_GT(read, 0u);
}

/// Reads a text that may be anything: it is a take or an error, and nothing else.
void read_anything(const Sample& sample, const std::string& motion, const std::string& skeleton) {
  try {
    if (sample.skeleton.empty()) {
      read_bvh(motion, "any.bvh");
    } else {
      read_amc(motion, "any.amc", std::make_shared<Skeleton>(read_asf(skeleton, "any.asf")));
    }
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::rejected_input);
    EXPECT_GT(error.place().line, 0u);
  }
}

TEST(Mutations, EveryTruncationIsATakeOrAnError) {
  for (const Sample& sample : samples()) {
    for (std::size_t size = 0; size < sample.motion.size(); ++size) {
      read_anything(sample, sample.motion.substr(0, size), sample.skeleton);
    }
    for (std::size_t size = 0; size < sample.skeleton.size(); ++size) {
      read_anything(sample, sample.motion, sample.skeleton.substr(0, size));
    }
  }
}

TEST(Mutations, ChangedBytesAreATakeOrAnError) {
  std::mt19937 random(1);
  for (const Sample& sample : samples()) {
    for (int i = 0; i < 2000; ++i) {
      std::string motion = sample.motion, skeleton = sample.skeleton;
      std::string& text = skeleton.empty() || i % 2 == 0 ? motion : skeleton;
      for (int k = 0; k <= i % 4; ++k) {
        text[random() % text.size()] = "0123456789 .-+e{}#:\n\r\tXyzJ\x80\0"[random() % 28];
      }
      read_anything(sample, motion, skeleton);
    }
  }
}

}  // namespace
}  // namespace reprise
