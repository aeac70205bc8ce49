#include "query/take_decoder.h"

#include <gtest/gtest.h>

#include "reprise/error.h"

namespace reprise {
namespace {

TEST(TakeDecoder, WhatTheMachineCannotHoldIsTold) {
  Skeleton skeleton;
  skeleton.channel_count = 60;
  TakeInfo take;
  take.name = "still";
  take.frames = 10'000'000;
  const std::size_t needed = decoding_memory(skeleton, take.frames);
  EXPECT_GT(needed, sizeof(double) * 60 * 10'000'000);
  EXPECT_NO_THROW(check_decoding_memory(take, skeleton, needed));
  try {
    check_decoding_memory(take, skeleton, needed - 1);
    ADD_FAILURE() << "more than there is";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::limit);
    EXPECT_NE(std::string(error.what()).find("'still' of 10000000 frames"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace reprise
