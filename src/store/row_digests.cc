#include "store/row_digests.h"

#include "store/take_block.h"

namespace reprise {
namespace {

/// What is known of a take but for its rows.
void add_take(Hasher& hasher, const TakeRecord& record) {
  const TakeInfo& info = record.info;
  hasher.add_text(info.name);
  hasher.add_text(info.subject);
  hasher.add_text(info.description);
  hasher.add_text(info.tags);
  hasher.add_number(info.frames);
  hasher.add_number(static_cast<int>(info.fidelity.tier));
  hasher.add_real(info.fidelity.limit_mm);
  hasher.add_real(info.fidelity.limit_deg);
  hasher.add_number(static_cast<std::int64_t>(info.text_bytes));
  hasher.add_number(micrometres(info.error_mm.mean));
  hasher.add_number(micrometres(info.error_mm.rms));
  hasher.add_number(micrometres(info.error_mm.p99));
  hasher.add_number(micrometres(info.error_mm.max));
  hasher.add_bytes(record.error_quantiles);
  hasher.add_number(micrometres(info.rotation_deg.mean));
  hasher.add_number(micrometres(info.rotation_deg.p99));
  hasher.add_number(micrometres(info.rotation_deg.max));
  for (const JointAt& worst : {info.worst_place, info.worst_turn}) {
    hasher.add_number(worst.joint);
    hasher.add_number(worst.frame);
  }
  hasher.add_bytes(record.turn_quantiles);
  for (const auto& [part, bytes] : record.spent) {
    hasher.add_number(static_cast<std::int64_t>(part_number(part)));
    hasher.add_number(static_cast<std::int64_t>(bytes));
  }
  hasher.add_text(info.source_digest);
}

}  // namespace

ShortDigest row_digest(const SkeletonRecord& record) {
  Hasher hasher;
  hasher.add_bytes(record.structure);
  hasher.add_number(static_cast<int>(record.format));
  hasher.add_number(static_cast<std::int64_t>(record.joints));
  hasher.add_number(static_cast<std::int64_t>(record.channels));
  hasher.add_text(record.root);
  return shortened(hasher.finish());
}

std::int64_t assumed_bits(const ProportionsRecord& record) {
  return (record.frame_rate_assumed ? assumed_frame_rate : 0) |
         (record.unit_assumed ? assumed_unit : 0) | (record.up_assumed ? assumed_up : 0);
}

std::optional<UpAxis> up_of_row(std::int64_t value) {
  if (value < 0 || value > static_cast<int>(UpAxis::minus_z)) return std::nullopt;
  return static_cast<UpAxis>(value);
}

Digest proportions_identity(const ProportionsRecord& record) {
  Hasher hasher;
  hasher.add_real(record.millimetres_per_unit);
  hasher.add_number(static_cast<int>(record.up));
  hasher.add_real(record.frame_rate);
  hasher.add_number(assumed_bits(record));
  hasher.add_text(record.asf_name);
  hasher.add_bytes(record.layout);
  hasher.add_text(record.source_text);
  return hasher.finish();
}

Digest space_digest(const Digest& structure, const Digest& base, const Bytes& data) {
  Hasher hasher;
  hasher.add_bytes(structure);
  hasher.add_bytes(base);
  hasher.add_bytes(data);
  return hasher.finish();
}

Digest take_content(const TakeRecord& record, const Digest& proportions, const Digest& space,
                    std::span<const Digest> layers, std::span<const ClipRecord> clips) {
  Hasher hasher;
  add_take(hasher, record);
  hasher.add_bytes(proportions);
  hasher.add_bytes(space);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    hasher.add_number(static_cast<int>(record.layers[i].kind));
    hasher.add_number(micrometres(record.layers[i].limit_mm));
    hasher.add_number(micrometres(record.layers[i].limit_deg));
    hasher.add_bytes(layers[i]);
  }
  for (const ClipRecord& clip : clips) {
    hasher.add_number(static_cast<std::int64_t>(clip.id));
    hasher.add_number(clip.first_frame);
    hasher.add_number(clip.frames);
    hasher.add_number(static_cast<int>(clip.kind));
    hasher.add_number(clip.group);
    hasher.add_number(static_cast<std::int64_t>(clip.primary));
    hasher.add_number(static_cast<std::int64_t>(clip.bytes));
  }
  return hasher.finish();
}

}  // namespace reprise
