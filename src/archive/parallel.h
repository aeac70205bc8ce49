// Work on many items at once, with results handed over in order.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace reprise {

/// Calls produce(i) for i in [0, count) on up to `jobs` threads, and consume(i, result) on this
/// thread in the order of i; results wait while too many are ahead, so that memory stays bounded.
/// Where one of them throws, no more is begun, and the exception that belongs to the smallest i
/// goes on from here.
template <class Produce, class Consume>
void produce_in_order(std::size_t count, unsigned jobs, Produce&& produce, Consume&& consume) {
  using Result = decltype(produce(std::size_t{0}));
  if (jobs <= 1 || count <= 1) {
    for (std::size_t i = 0; i < count; ++i) consume(i, produce(i));
    return;
  }
  struct Slot {
    std::vector<Result> result;  // one, or none where there is an exception
    std::exception_ptr exception;
  };
  std::mutex mutex;
  std::condition_variable changed;
  std::map<std::size_t, Slot> ready;
  std::size_t next = 0, wanted = 0;
  bool stopped = false;
  const std::size_t most_ahead = 4 * std::size_t{jobs};

  const auto work = [&] {
    for (;;) {
      std::size_t i;
      {
        std::unique_lock lock(mutex);
        changed.wait(lock, [&] { return stopped || next >= count || next < wanted + most_ahead; });
        if (stopped || next >= count) return;
        i = next++;
      }
      Slot slot;
      try {
        slot.result.push_back(produce(i));
      } catch (...) {
        slot.exception = std::current_exception();
      }
      const std::lock_guard lock(mutex);
      ready.emplace(i, std::move(slot));
      changed.notify_all();
    }
  };
  std::vector<std::jthread> threads;
  const auto stop = [&] {
    const std::lock_guard lock(mutex);
    stopped = true;
    changed.notify_all();
  };
  try {
    for (std::size_t t = 0; t < std::min<std::size_t>(jobs, count); ++t) threads.emplace_back(work);
    for (std::size_t i = 0; i < count; ++i) {
      Slot slot;
      {
        std::unique_lock lock(mutex);
        wanted = i;
        changed.notify_all();
        changed.wait(lock, [&] { return ready.contains(i); });
        slot = std::move(ready.at(i));
        ready.erase(i);
      }
      if (slot.exception) std::rethrow_exception(slot.exception);
      consume(i, std::move(slot.result.front()));
    }
  } catch (...) {
    stop();
    throw;
  }
}

}  // namespace reprise
