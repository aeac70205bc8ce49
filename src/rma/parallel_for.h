// The same work on many items, on several threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "model/start_threads.h"

namespace reprise {

/// 0 stands for a thread a core.
inline unsigned thread_count(unsigned jobs) {
  return jobs > 0 ? jobs : std::max(1u, std::thread::hardware_concurrency());
}

/// Calls work(i) for i in [0, count) in any order on up to `jobs` threads, this one among them.
/// Where one of them throws, no more is begun, and its exception goes on from here.
template <class Work>
void parallel_for(std::size_t count, unsigned jobs, Work&& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto run = [&] {
    try {
      for (std::size_t i; (i = next++) < count;) work(i);
    } catch (...) {
      next = count;
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> threads;
    const std::size_t most = std::min<std::size_t>(thread_count(jobs), count);
    if (most > 1) {
      try {
        start_threads(threads, most - 1, run);
      } catch (...) {
        next = count;  // those that run have nothing more to do
        throw;
      }
    }
    run();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace reprise
