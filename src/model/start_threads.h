// Threads, as many as the system has.
#pragma once

#include <cstddef>
#include <system_error>
#include <thread>
#include <vector>

namespace reprise {

/// Starts `count` threads that call `work`, or fewer, even none, where the system gives no more of
/// them: results do not depend on their number.
template <class Work>
void start_threads(std::vector<std::jthread>& threads, std::size_t count, const Work& work) {
  threads.reserve(threads.size() + count);
  try {
    for (std::size_t t = 0; t < count; ++t) threads.emplace_back(work);
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::resource_unavailable_try_again) throw;
  }
}

}  // namespace reprise
