// What is said of coded texts that no encoder wrote, and how long a text may be.
#pragma once

#include <cstddef>
#include <string>

#include "reprise/error.h"

namespace reprise {

struct TextLimits {
  static constexpr std::size_t bytes = std::size_t{1} << 31;  ///< InputLimits::file_bytes
};

[[noreturn]] inline void throw_damaged_text(const char* why) {
  throw Error(ErrorCode::damaged, std::string("a coded text is damaged: ") + why);
}

}  // namespace reprise
