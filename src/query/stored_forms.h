// Skeletons, layouts and spaces as they are stored, and back.
#pragma once

#include <memory>

#include "quant/space_codec.h"
#include "reprise/model/take.h"
#include "store/archive_store.h"

namespace reprise {

/// What a take's files say besides numbers; its skeleton row is left open.
ProportionsRecord proportions_record(const Skeleton& skeleton, const TakeLayout& layout,
                                     double frame_rate, bool frame_rate_assumed);

/// A take without frames, as its proportions say. Throws Error (damaged).
Take empty_take(const ProportionsRecord& record, MotionFormat format);

/// Proportions whose text is a skeleton of the structure that they are stored for. Throws Error
/// (damaged).
ProportionsRecord read_proportions(const ArchiveStore& store, std::int64_t id);

/// The skeleton that the spaces of a stored skeleton are made for. Throws Error (damaged).
Skeleton reference_skeleton(const ArchiveStore& store, std::int64_t skeleton);

/// A space with all that it extends. Throws Error (damaged).
CodedSpace read_space(const ArchiveStore& store, std::int64_t id);

/// The known values of a space of a skeleton with so many channels. Throws Error (damaged).
KnownValues read_known_values(const ArchiveStore& store, std::int64_t space, std::size_t channels);

}  // namespace reprise
