#include "archive/memory_budget.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace reprise {
namespace {

constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();
/// Bytes a frame for each channel (twists, numbers and knots, as they are and as they are decoded)
/// and for each joint (where it is and where it is decoded to).
constexpr std::size_t channel_bytes = 150, joint_bytes = 260;

/// The limit of a control group; a file that is not there, or says "max", is none.
std::size_t group_limit(const char* path) {
  std::size_t bytes = 0;
  return std::ifstream(path) >> bytes ? bytes : no_limit;
}

std::size_t available_memory() {
  std::ifstream facts("/proc/meminfo");
  for (std::string name, rest; facts >> name;) {
    std::size_t kibibytes = 0;
    if (name == "MemAvailable:" && facts >> kibibytes) return kibibytes * 1024;
    std::getline(facts, rest);
  }
  return no_limit;
}

}  // namespace

std::size_t free_memory() {
  return std::min({available_memory(), group_limit("/sys/fs/cgroup/memory.max"),
                   group_limit("/sys/fs/cgroup/memory/memory.limit_in_bytes")});
}

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
