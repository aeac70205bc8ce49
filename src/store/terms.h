// What lists ask for, and the blocks of takes that have it.
#pragma once

#include <cstdint>
#include <set>

#include "store/take_block.h"
#include "store/words.h"

namespace reprise {

/// Keys of terms: a word, a whole subject or a kind of clips that a take has. Different terms may
/// have the same key.
using TermKeys = std::set<std::int64_t>;

/// Of all takes of a block.
TermKeys terms_of(const TakeBlock& block, const WordSplitter& splitter);
/// What a block must have to hold a take that passes the filter; `filter.take` is left out.
TermKeys terms_of(const TakeFilter& filter, const WordSplitter& splitter);

}  // namespace reprise
