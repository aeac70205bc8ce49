// What a stored clip is to those who ask.
#pragma once

#include "store/archive_store.h"

namespace reprise {

/// `take` is the one that the clip is of.
ClipInfo clip_info(const ClipRecord& record, const TakeInfo& take);

}  // namespace reprise
