// Digests of what rows hold (docs/format.md).
#pragma once

#include <optional>
#include <span>

#include "store/archive_store.h"
#include "store/digest.h"

namespace reprise {

/// Bits of the column `assumed` of proportions. Persisted: never change a value.
constexpr std::int64_t assumed_frame_rate = 1, assumed_unit = 2, assumed_up = 4;
std::int64_t assumed_bits(const ProportionsRecord& record);
/// The axis of the column `up`; none for a number that is none.
std::optional<UpAxis> up_of_row(std::int64_t value);

ShortDigest row_digest(const SkeletonRecord& record);
Digest proportions_identity(const ProportionsRecord& record);
Digest space_digest(const Digest& structure, const Digest& base, const Bytes& data);
/// What a take is, wherever it stands in an archive; `layers` are the digests of its layers' data.
Digest take_content(const TakeRecord& record, const Digest& proportions, const Digest& space,
                    std::span<const Digest> layers, std::span<const ClipRecord> clips);

}  // namespace reprise
