// Keeps takes that are coded or decoded at the same time within the memory that the machine has.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace reprise {

class MemoryBudget {
 public:
  explicit MemoryBudget(std::size_t bytes) : free_(bytes) {}

  /// Given back when it ends.
  class Share {
   public:
    Share(MemoryBudget& budget, std::size_t bytes) : budget_(budget), bytes_(bytes) {}
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;
    ~Share() { budget_.give_back(bytes_); }

   private:
    MemoryBudget& budget_;
    std::size_t bytes_;
  };

  /// Waits until so much is free, or nothing else is taken: what is larger than the whole budget
  /// goes alone. May be called from several threads, each of which holds one share at most.
  Share take(std::size_t bytes);

 private:
  void give_back(std::size_t bytes);

  std::mutex mutex_;
  std::condition_variable given_back_;
  std::size_t free_;
  std::size_t taken_ = 0;
};

}  // namespace reprise
