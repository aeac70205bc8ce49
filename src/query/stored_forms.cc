#include "query/stored_forms.h"

#include "reprise/error.h"
#include "reprise/formats/motion_file.h"
#include "store/digest.h"

namespace reprise {
namespace {

/// Far from where sums of it overflow.
constexpr std::uint64_t most_first_frame = std::uint64_t{1} << 60;

/// Millimetres in a unit of length; nothing that is measured in it overflows.
constexpr double greatest_unit_mm = 1e15;

[[noreturn]] void throw_damaged(const std::string& why) {
  throw Error(ErrorCode::damaged, "the archive is damaged: " + why);
}

class LayoutWriter {
 public:
  void number(std::uint64_t value) {
    for (; value >= 128; value >>= 7) bytes_.push_back(static_cast<std::uint8_t>(value | 128));
    bytes_.push_back(static_cast<std::uint8_t>(value));
  }
  void text(const std::string& text) {
    number(text.size());
    bytes_.insert(bytes_.end(), text.begin(), text.end());
  }
  Bytes finish() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

class LayoutReader {
 public:
  explicit LayoutReader(const Bytes& bytes) : bytes_(bytes) {}
  std::uint64_t number() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 63; shift += 7) {
      if (at_ >= bytes_.size()) throw_damaged("a header ends too early");
      const std::uint8_t byte = bytes_[at_++];
      value |= std::uint64_t{byte & 127u} << shift;
      if ((byte & 128) == 0) return value;
    }
    throw_damaged("a header holds a number that is too large");
  }
  std::string text() {
    const std::uint64_t size = number();
    if (size > bytes_.size() - at_) throw_damaged("a header ends too early");
    std::string text(bytes_.begin() + static_cast<std::ptrdiff_t>(at_),
                     bytes_.begin() + static_cast<std::ptrdiff_t>(at_ + size));
    at_ += size;
    return text;
  }

 private:
  const Bytes& bytes_;
  std::size_t at_ = 0;
};

Bytes pack_layout(const TakeLayout& layout) {
  LayoutWriter writer;
  writer.text(layout.frame_time_text);
  writer.text(layout.amc_header);
  writer.number(layout.amc_joints.size());
  for (const int joint : layout.amc_joints) writer.number(static_cast<std::uint64_t>(joint));
  writer.number(static_cast<std::uint64_t>(layout.first_frame_number));
  writer.number(layout.radians);
  return writer.finish();
}

TakeLayout unpack_layout(const Bytes& bytes, std::size_t joints) {
  LayoutReader reader(bytes);
  TakeLayout layout;
  layout.frame_time_text = reader.text();
  layout.amc_header = reader.text();
  const std::uint64_t count = reader.number();
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t joint = reader.number();
    if (joint >= joints) throw_damaged("a header names a joint that is not there");
    layout.amc_joints.push_back(static_cast<int>(joint));
  }
  const std::uint64_t first_frame = reader.number();
  if (first_frame > most_first_frame) throw_damaged("a header counts frames from nowhere");
  layout.first_frame_number = static_cast<long>(first_frame);
  layout.radians = reader.number() != 0;
  return layout;
}

std::string amc_header(const Bytes& layout) {
  LayoutReader reader(layout);
  reader.text();  // the frame time
  return reader.text();
}

std::shared_ptr<const Skeleton> skeleton_of(const ProportionsRecord& record, MotionFormat format) {
  const std::string where = "the stored skeleton";
  try {
    auto skeleton = std::make_shared<Skeleton>(
        format == MotionFormat::bvh
            ? read_bvh_skeleton(record.source_text, where, record.millimetres_per_unit)
            : read_asf(record.source_text, where, amc_has_all_turns(amc_header(record.layout))));
    skeleton->asf_name = record.asf_name;
    skeleton->up = record.up;
    skeleton->up_assumed = record.up_assumed;
    skeleton->unit_assumed = record.unit_assumed;
    return skeleton;
  } catch (const Error& error) {
    throw_damaged(error.reason());
  }
}

/// Whether the skeleton's text has the structure that its row says: decoders count on it.
std::shared_ptr<const Skeleton> checked_skeleton(const ProportionsRecord& record,
                                                 const SkeletonRecord& row) {
  auto skeleton = skeleton_of(record, row.format);
  if (digest_of(structure_bytes(*skeleton)) != row.structure) {
    throw_damaged("a skeleton is not of the structure that is stored of it");
  }
  return skeleton;
}

}  // namespace

ProportionsRecord proportions_record(const Skeleton& skeleton, const TakeLayout& layout,
                                     double frame_rate, bool frame_rate_assumed) {
  ProportionsRecord record;
  record.millimetres_per_unit = skeleton.millimetres_per_unit;
  record.up = skeleton.up;
  record.up_assumed = skeleton.up_assumed;
  record.unit_assumed = skeleton.unit_assumed;
  record.frame_rate = frame_rate;
  record.frame_rate_assumed = frame_rate_assumed;
  record.asf_name = skeleton.asf_name;
  record.layout = pack_layout(layout);
  record.source_text = skeleton.source_text;
  return record;
}

Take empty_take(const ProportionsRecord& record, MotionFormat format) {
  Take take;
  take.skeleton = skeleton_of(record, format);
  take.frame_rate = record.frame_rate;
  take.frame_rate_assumed = record.frame_rate_assumed;
  take.layout = unpack_layout(record.layout, take.skeleton->joints.size());
  return take;
}

ProportionsRecord read_proportions(const ArchiveStore& store, std::int64_t id) {
  ProportionsRecord record = store.proportions(id);
  if (!(record.millimetres_per_unit >= 1 / greatest_unit_mm &&
        record.millimetres_per_unit <= greatest_unit_mm)) {
    throw_damaged("a skeleton's unit makes no sense");
  }
  checked_skeleton(record, store.skeleton(record.skeleton));
  return record;
}

Skeleton reference_skeleton(const ArchiveStore& store, std::int64_t skeleton) {
  return *checked_skeleton(store.reference_proportions(skeleton), store.skeleton(skeleton));
}

CodedSpace read_space(const ArchiveStore& store, std::int64_t id) {
  const std::vector<SpaceRecord> spaces = store.space_chain(id).spaces;
  const Skeleton reference = reference_skeleton(store, spaces.front().skeleton);
  CodedSpace coded = unpack_space(spaces.front().data, reference, nullptr);
  for (std::size_t i = 1; i < spaces.size(); ++i)
    coded = unpack_space(spaces[i].data, reference, &coded.space);
  return coded;
}

KnownValues read_known_values(const ArchiveStore& store, std::int64_t space, std::size_t channels) {
  return unpack_known_values(store.space_chain(space).spaces.front().data, channels);
}

}  // namespace reprise
