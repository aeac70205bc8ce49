#include "model/free_memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace reprise {
namespace {

constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

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

}  // namespace reprise
