#include "archive/memory_budget.h"

#include <algorithm>

namespace reprise {
namespace {

/// Bytes a frame for each channel (twists, numbers and knots, as they are and as they are decoded)
/// and for each joint (where it is and where it is decoded to).
constexpr std::size_t channel_bytes = 150, joint_bytes = 260;

}  // namespace

std::size_t coding_memory(const Skeleton& skeleton, long frames) {
  const std::size_t a_frame = channel_bytes * static_cast<std::size_t>(skeleton.channel_count) +
                              joint_bytes * skeleton.joints.size();
  return static_cast<std::size_t>(frames) * a_frame;
}

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
