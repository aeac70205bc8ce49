// Work on many items at once, with results handed over in order.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "model/start_threads.h"

namespace reprise {

/// Calls produce(i) for i in [0, count) on up to `jobs` threads, and consume(i, result) on this
/// thread in the order of i; results wait while too many are ahead, so that memory stays bounded.
/// Where one of them throws, no more is begun, and the exception that belongs to the smallest i
/// goes on from here. Where the system has fewer threads, the work is done by those, or by this
/// one.
template <class Produce, class Consume>
void produce_in_order(std::size_t count, unsigned jobs, Produce&& produce, Consume&& consume) {
  using Result = decltype(produce(std::size_t{0}));
  struct Slot {
    std::optional<Result> result;  // none where there is an exception
    std::exception_ptr exception;
    bool ready = false;
  };
  const std::size_t most_threads = std::min<std::size_t>(jobs, count);
  // Taken before the threads begin: what they do outside of `produce` must not throw, since nothing
  // could catch it there.
  std::vector<Slot> slots(most_threads > 1 ? 4 * most_threads : 0);
  std::mutex mutex;
  std::condition_variable changed;
  std::size_t next = 0, wanted = 0;
  bool stopped = false;

  const auto work = [&] {
    for (;;) {
      std::size_t i;
      {
        std::unique_lock lock(mutex);
        changed.wait(lock,
                     [&] { return stopped || next >= count || next < wanted + slots.size(); });
        if (stopped || next >= count) return;
        i = next++;
      }
      // Nobody else looks at it before it is ready.
      Slot& slot = slots[i % slots.size()];
      try {
        slot.result.emplace(produce(i));
      } catch (...) {
        slot.exception = std::current_exception();
      }
      const std::lock_guard lock(mutex);
      slot.ready = true;
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
    if (most_threads > 1) start_threads(threads, most_threads, work);
    if (threads.empty()) {
      for (std::size_t i = 0; i < count; ++i) consume(i, produce(i));
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      Slot slot;
      {
        Slot& filled = slots[i % slots.size()];
        std::unique_lock lock(mutex);
        changed.wait(lock, [&] { return filled.ready; });
        slot = std::exchange(filled, Slot());
        wanted = i + 1;
        changed.notify_all();
      }
      if (slot.exception) std::rethrow_exception(slot.exception);
      consume(i, std::move(*slot.result));
    }
  } catch (...) {
    stop();
    throw;
  }
}

}  // namespace reprise
