#include "quant/axis_coder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "ingest/skeletons.h"

namespace reprise {
namespace {

class AxisCoding : public testing::Test {
 protected:
  AxisCoding() {
    const auto skeleton = testing_skeletons::branches();
    LayoutChoices choices;
    choices.active.assign(static_cast<std::size_t>(skeleton->channel_count), true);
    layout_ = make_marker_layout(*skeleton, choices);
    for (int d = 0; d < layout_.dimensions(); ++d)
      mean_.push_back(static_cast<int>(random_() % 900));
  }

  std::vector<std::int32_t> noise(double size) {
    std::normal_distribution<double> normal(0, size);
    std::vector<std::int32_t> entries;
    for (int d = 0; d < layout_.dimensions(); ++d)
      entries.push_back(static_cast<std::int32_t>(std::lround(normal(random_))));
    return entries;
  }
  std::vector<std::uint8_t> coded(const std::vector<std::vector<std::int32_t>>& axes) const {
    RangeEncoder encoder;
    AxisCoder coder(layout_, mean_);
    for (const auto& axis : axes) coder.encode(encoder, {6, 1}, axis);
    return encoder.finish();
  }

  std::mt19937 random_{7};
  MarkerLayout layout_;
  std::vector<std::int32_t> mean_;
};

TEST_F(AxisCoding, EntriesComeBackWhateverTheirSize) {
  std::vector<std::vector<std::int32_t>> axes;
  for (const double size : {300.0, 40.0, 5.0, 0.4, 0.0, 1e5, 1e8, 2.0}) axes.push_back(noise(size));
  for (auto& axis : axes)
    for (auto& entry : axis)
      entry = std::clamp(entry, -AxisCoder::most_entry, AxisCoder::most_entry);
  RangeEncoder encoder;
  AxisCoder writer(layout_, mean_);
  const auto scale = [](std::size_t k) {
    return AxisScale{static_cast<int>(3 * k), k % 2 == 0 ? 63 : -63};
  };
  for (std::size_t k = 0; k < axes.size(); ++k) writer.encode(encoder, scale(k), axes[k]);
  const auto bytes = encoder.finish();
  RangeDecoder decoder(bytes);
  AxisCoder reader(layout_, mean_);
  for (std::size_t k = 0; k < axes.size(); ++k) {
    std::vector<std::int32_t> entries(axes[k].size());
    ASSERT_TRUE(reader.decode(decoder, scale(k), entries));
    EXPECT_EQ(entries, axes[k]) << "axis " << k;
  }
  EXPECT_FALSE(decoder.ran_out());
}

TEST_F(AxisCoding, MarkersThatMoveTogetherTakeFewerBytes) {
  std::vector<std::vector<std::int32_t>> apart, together;
  for (int k = 0; k < 12; ++k) {
    apart.push_back(noise(40));
    std::vector<std::int32_t> entries = noise(40);
    for (std::size_t d = 3; d < entries.size(); ++d) entries[d] = entries[d % 3];
    together.push_back(entries);
  }
  EXPECT_LT(coded(together).size(), coded(apart).size() / 2);
}

TEST_F(AxisCoding, EntriesBeyondTheMostAreCut) {
  std::vector<std::int32_t> entries(static_cast<std::size_t>(layout_.dimensions()), 0);
  entries[4] = std::numeric_limits<std::int32_t>::max();
  entries[5] = std::numeric_limits<std::int32_t>::min();
  const auto bytes = coded({entries});
  RangeDecoder decoder(bytes);
  std::vector<std::int32_t> decoded(entries.size());
  ASSERT_TRUE(AxisCoder(layout_, mean_).decode(decoder, {6, 1}, decoded));
  EXPECT_EQ(decoded[4], AxisCoder::most_entry);
  EXPECT_EQ(decoded[5], -AxisCoder::most_entry);
}

TEST_F(AxisCoding, AnyBytesAreEntriesWithinTheMostOrRefused) {
  for (int i = 0; i < 200; ++i) {
    std::vector<std::uint8_t> bytes(random_() % 300);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random_());
    RangeDecoder decoder(bytes);
    AxisCoder coder(layout_, mean_);
    std::vector<std::int32_t> entries(static_cast<std::size_t>(layout_.dimensions()));
    for (int k = 0; k < 8 && coder.decode(decoder, {k, 0}, entries); ++k) {
      for (const std::int32_t entry : entries) {
        EXPECT_LE(entry, AxisCoder::most_entry);
        EXPECT_GE(entry, -AxisCoder::most_entry);
      }
    }
  }
}

}  // namespace
}  // namespace reprise
