// How much memory the machine has left.
#pragma once

#include <cstddef>

namespace reprise {

/// Bytes that a process may still take: the lesser of what the system has available and what its
/// control group (a container) may have in all. The largest number where neither says.
std::size_t free_memory();

}  // namespace reprise
