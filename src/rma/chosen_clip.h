// A clip of a take, and what part it plays among the others (lin-2011 section 4.2.2).
#pragma once

#include <cstddef>
#include <vector>

namespace reprise {

enum class ClipRole { primary, repeated, unique };

/// Samples [begin, end) of a take.
struct ChosenClip {
  std::size_t take = 0;
  long begin = 0;
  long end = 0;
  ClipRole role = ClipRole::unique;
  std::size_t primary = 0;  ///< of a repeated clip: the index of its primary among all clips
  /// Of a repeated clip: of each of its samples the sample of the primary's take beside it, in
  /// order and within the primary.
  std::vector<long> reference;
};

}  // namespace reprise
