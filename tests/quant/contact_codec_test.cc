#include "quant/contact_codec.h"

#include <gtest/gtest.h>

#include <random>

namespace reprise {
namespace {

TakeContacts random_contacts(const ContactShape& shape, std::mt19937& random) {
  TakeContacts contacts;
  contacts.hold = static_cast<int>(random() % 4);
  int point = 0;
  for (const int points : shape.points_of_legs) {
    for (int p = 0; p < points; ++p, ++point) {
      long unit = static_cast<long>(random() % 20);
      while (unit < shape.units()) {
        const long end = unit + 1 + static_cast<long>(random() % 40);
        contacts.intervals.push_back(
            {point, unit * shape.unit, std::min(end * shape.unit, shape.frames)});
        unit = end + 1 + static_cast<long>(random() % 40);
      }
    }
  }
  return contacts;
}

TEST(ContactCodec, ContactsComeBack) {
  std::mt19937 random(1);
  for (const long frames : {1L, 2L, 7L, 200L, 1003L}) {
    for (const long unit : {1L, 4L}) {
      const ContactShape shape{{2, 2, 1}, frames, unit};
      const TakeContacts contacts = random_contacts(shape, random);
      RangeEncoder encoder;
      encode_contacts(encoder, shape, contacts);
      const auto bytes = encoder.finish();
      RangeDecoder decoder(bytes);
      const TakeContacts decoded = decode_contacts(decoder, shape);
      EXPECT_EQ(decoded.intervals, contacts.intervals);
      if (!contacts.intervals.empty()) EXPECT_EQ(decoded.hold, contacts.hold);
    }
  }
}

TEST(ContactCodec, WhateverTheBytesSayContactsAreInTheTake) {
  std::mt19937 random(2);
  for (int i = 0; i < 300; ++i) {
    const ContactShape shape{
        {2, 1}, 1 + static_cast<long>(random() % 300), 1 + static_cast<long>(random() % 5)};
    std::vector<std::uint8_t> bytes(random() % 40);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    RangeDecoder decoder(bytes);
    const TakeContacts decoded = decode_contacts(decoder, shape);
    EXPECT_LT(decoded.hold, 4);
    for (std::size_t c = 0; c < decoded.intervals.size(); ++c) {
      const ContactInterval& contact = decoded.intervals[c];
      EXPECT_GE(contact.first, 0);
      EXPECT_LT(contact.first, contact.end);
      EXPECT_LE(contact.end, shape.frames);
      EXPECT_LT(contact.point, 3);
      if (c == 0 || decoded.intervals[c - 1].point != contact.point) continue;
      EXPECT_LT(decoded.intervals[c - 1].end, contact.first);
    }
  }
}

TEST(ContactCodec, BytesThatEndEndTheContacts) {
  RangeDecoder decoder({});
  EXPECT_LT(decode_contacts(decoder, {{2, 2}, 1000000, 1}).intervals.size(), 1000u);
}

}  // namespace
}  // namespace reprise
