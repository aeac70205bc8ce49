// What a layer promises of a take, held against the take's source.
#pragma once

#include <string>

#include "reprise/model/measure.h"
#include "store/archive_store.h"

namespace reprise {

/// Degrees by which a joint's turn against its parent from one frame to the next exceeds the
/// source's, at most; both takes are of one structure and length.
double greatest_pop(const Take& original, const Take& decoded);

/// The first thing that a layer promises and does not keep, as a sentence without a subject; empty
/// where it keeps all. `errors` are those between the two takes, of one structure and length.
std::string broken_promise(const LayerRecord& layer, const Take& original, const Take& decoded,
                           const MotionErrors& errors);

}  // namespace reprise
