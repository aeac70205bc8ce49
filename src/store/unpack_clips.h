#pragma once

#include "store/take_columns.h"

namespace reprise {

/// Reads the clips of all takes, whose frames are known. Throws Error (damaged).
void unpack_clips(std::vector<StoredTake>& takes, ColumnReader& reader);

}  // namespace reprise
