#include "quant/take_header.h"

#include <gtest/gtest.h>

#include <random>

#include "quant/known_values.h"
#include "reprise/error.h"
#include "reprise/model/kinematics.h"
#include "reprise/synth/library.h"

namespace reprise {
namespace {

Take synthetic_take(MotionFormat format) {
  SynthOptions options;
  options.takes = 1;
  options.seconds = 3;
  options.format = format;
  return make_synthetic_library(options).takes.at(0);
}

class TakeHeaders : public testing::TestWithParam<MotionFormat> {
 protected:
  TakeHeader through_bytes(const TakeHeader& header, const KnownValues& known = {}) const {
    const std::vector<std::uint8_t> data = {1, 2, 3};
    const auto bytes = join_header(*take_.skeleton, known, take_.frames(), header, data);
    const SplitLayer split = split_header(*take_.skeleton, known, take_.frames(), bytes);
    EXPECT_TRUE(std::ranges::equal(split.data, data));
    return split.header;
  }

  Take take_ = synthetic_take(GetParam());
};

TEST_P(TakeHeaders, ComeBackFromTheirBytes) {
  take_.channels.col(3).setConstant(7.12502);
  take_.channels.col(4).setConstant(-0.1234567891);
  take_.channels.col(5).setConstant(1e17 / 3);
  const TakeHeader header = prepare_take(take_).header;
  ASSERT_TRUE(header.constants[3] && header.constants[5]);
  EXPECT_EQ(*header.constants[3], 7.12502);
  EXPECT_EQ(through_bytes(header), header);
  KnownValues known(header.constants.size());
  known[3] = {1.5, 7.12502};
  known[4] = {*header.constants[4]};
  const auto with = join_header(*take_.skeleton, known, take_.frames(), header, {});
  EXPECT_LT(with.size(), join_header(*take_.skeleton, {}, take_.frames(), header, {}).size());
  EXPECT_EQ(through_bytes(header, known), header);
  EXPECT_EQ(decode_known_values(encode_known_values(known), known.size()), known);
}

TEST_P(TakeHeaders, ATPoseInFrontIsNoPartOfTheMotion) {
  const Take plain = take_;
  take_.channels.row(0) = take_.channels.row(1);
  for (const Joint& joint : take_.skeleton->joints) {
    for (const int slot : joint.rotation_slots) take_.channels(0, joint.first_channel + slot) = 0;
  }
  take_.channels(0, take_.skeleton->joints.front().first_channel) += 30;
  for (const Joint& joint : take_.skeleton->joints) {
    if (joint.rotation_slots.size() == 3)
      take_.channels(0, joint.first_channel + joint.rotation_slots[0]) = 77.25;
  }
  const PreparedTake prepared = prepare_take(take_);
  ASSERT_FALSE(prepared.header.first_frame.empty());
  EXPECT_EQ(prepared.take.frames(), take_.frames() - 1);
  EXPECT_EQ(through_bytes(prepared.header), prepared.header);
  const ChannelMatrix back = restore_take(*take_.skeleton, prepared.header, prepared.take.channels);
  ASSERT_EQ(back.rows(), take_.frames());
  EXPECT_LT((back - take_.channels).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_TRUE(prepare_take(plain).header.first_frame.empty());
}

TEST_P(TakeHeaders, ChannelsThatDoNotMoveComeOutAsOneValue) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> tremble(-4e-5, 4e-5);
  for (double& value : take_.channels.col(4).reshaped()) value = 12.5 + tremble(random);
  const PreparedTake prepared = prepare_take(take_);
  ASSERT_TRUE(prepared.header.constants[4]);
  const ChannelMatrix back = restore_take(*take_.skeleton, prepared.header, prepared.take.channels);
  EXPECT_EQ(back.col(4).maxCoeff(), back.col(4).minCoeff());
  EXPECT_NEAR(back(0, 4), 12.5, 1e-4);
}

TEST_P(TakeHeaders, HostileBytesAreDamageOrAHeader) {
  take_.channels.col(3).setConstant(7.12502);
  for (Eigen::Index f = take_.frames() / 2; f < take_.frames(); ++f) take_.channels(f, 4) += 360;
  const PreparedTake prepared = prepare_take(take_);
  ASSERT_FALSE(prepared.header.branches.empty());
  const auto good = join_header(*take_.skeleton, {}, take_.frames(), prepared.header, {});
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    auto bytes = good;
    if (i % 3 == 0) bytes.resize(random() % bytes.size());
    for (int k = 0; k < 1 + i % 4 && !bytes.empty(); ++k) {
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    try {
      const SplitLayer split = split_header(*take_.skeleton, {}, take_.frames(), bytes);
      const long frames = prepared_frames(split.header, take_.frames());
      const ChannelMatrix channels = restore_take(
          *take_.skeleton, split.header, ChannelMatrix::Zero(frames, take_.channels.cols()));
      EXPECT_EQ(channels.rows(), take_.frames());
      EXPECT_TRUE(channels.allFinite());
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::damaged);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, TakeHeaders,
                         testing::Values(MotionFormat::bvh, MotionFormat::asf_amc));

}  // namespace
}  // namespace reprise
