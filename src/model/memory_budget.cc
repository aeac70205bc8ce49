#include "model/memory_budget.h"

#include <algorithm>

namespace reprise {

MemoryBudget::Share MemoryBudget::take(std::size_t bytes) {
  std::unique_lock lock(mutex_);
  given_back_.wait(lock, [&] { return bytes <= free_ || taken_ == 0; });
  bytes = std::min(bytes, free_);
  free_ -= bytes;
  taken_ += bytes;
  return {*this, bytes};
}

void MemoryBudget::give_back(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  free_ += bytes;
  taken_ -= bytes;
  given_back_.notify_all();
}

}  // namespace reprise
