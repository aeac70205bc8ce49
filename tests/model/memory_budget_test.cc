#include "model/memory_budget.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace reprise {
namespace {

TEST(MemoryBudgetTest, NeverGivesMoreThanThereIs) {
  constexpr std::size_t whole = 100;
  MemoryBudget budget(whole);
  std::atomic<std::size_t> taken{0}, most{0};
  std::vector<std::jthread> threads;
  for (std::size_t t = 0; t < 8; ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t i = 0; i < 200; ++i) {
        const std::size_t bytes = 1 + (31 * t + 17 * i) % 60;
        const auto share = budget.take(bytes);
        const std::size_t now = taken += bytes;
        for (std::size_t seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
        }
        taken -= bytes;
      }
    });
  }
  threads.clear();
  EXPECT_LE(most, whole);
  EXPECT_EQ(taken, 0u);
}

TEST(MemoryBudgetTest, WhatIsLargerThanAllGoesAlone) {
  MemoryBudget budget(10);
  std::atomic<bool> beside{false};
  std::jthread other;
  {
    const auto share = budget.take(1000);
    other = std::jthread([&] {
      const auto small = budget.take(1);
      beside = true;
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_FALSE(beside);
  }
  other.join();
  EXPECT_TRUE(beside);
  const auto first = budget.take(4), second = budget.take(6);
}

}  // namespace
}  // namespace reprise
