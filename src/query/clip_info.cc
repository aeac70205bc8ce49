#include "query/clip_info.h"

#include "store/digest.h"

namespace reprise {
namespace {

std::string hexadecimal_id(std::uint64_t address) {
  Bytes bytes;
  for (int shift = 56; shift >= 0; shift -= 8)
    bytes.push_back(static_cast<std::uint8_t>(address >> shift));
  return hexadecimal(bytes);
}

}  // namespace

ClipInfo clip_info(const ClipRecord& record, const TakeInfo& take) {
  ClipInfo info;
  info.id = hexadecimal_id(record.id);
  info.take = take.name;
  info.kind = record.kind;
  info.group = record.group;
  info.first_frame = record.first_frame;
  info.frames = record.frames;
  info.start = static_cast<double>(record.first_frame) / take.frame_rate;
  info.end = static_cast<double>(record.first_frame + record.frames) / take.frame_rate;
  if (record.kind == ClipKind::repeated) info.primary = hexadecimal_id(record.primary);
  info.bytes = record.bytes;
  return info;
}

}  // namespace reprise
