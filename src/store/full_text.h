// Takes by the words that are told of them.
#pragma once

#include <string>
#include <vector>

#include "reprise/archive.h"
#include "store/database.h"

namespace reprise {

/// Those of `takes` with all words of `text` in their name, subject, description or tags, searched
/// with FTS5 in a table that lives only in memory: nothing that is stored can be out of date or
/// damaged.
std::vector<TakeInfo> takes_with_words(const Database& database, const std::vector<TakeInfo>& takes,
                                       const std::string& text);

}  // namespace reprise
