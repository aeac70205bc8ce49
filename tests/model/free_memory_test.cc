#include "model/free_memory.h"

#include <gtest/gtest.h>

namespace reprise {
namespace {

TEST(FreeMemoryTest, TheMachineHasSome) {
  constexpr std::size_t bytes = std::size_t{1} << 20;
  EXPECT_GT(free_memory(), bytes);
}

}  // namespace
}  // namespace reprise
