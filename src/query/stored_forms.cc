#include "query/stored_forms.h"

#include "reprise/error.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

/// Spaces that extend each other deeper than this were not made by an ingest.
constexpr int most_extensions = 1000;

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
  layout.first_frame_number = static_cast<long>(reader.number());
  layout.radians = reader.number() != 0;
  return layout;
}

std::shared_ptr<const Skeleton> skeleton_of(const ProportionsRecord& record, MotionFormat format) {
  const std::string where = "the stored skeleton";
  try {
    auto skeleton = std::make_shared<Skeleton>(
        format == MotionFormat::bvh
            ? read_bvh_skeleton(record.source_text, where, record.millimetres_per_unit)
            : read_asf(record.source_text, where));
    skeleton->asf_name = record.asf_name;
    return skeleton;
  } catch (const Error& error) {
    throw_damaged(error.reason());
  }
}

CodedSpace read_space(const ArchiveStore& store, std::int64_t id, int depth) {
  if (depth > most_extensions) throw_damaged("spaces extend each other without end");
  const SpaceRecord record = store.space(id);
  const Skeleton reference = reference_skeleton(store, record.skeleton);
  if (record.base == 0) return unpack_space(record.data, reference, nullptr);
  const CodedSpace base = read_space(store, record.base, depth + 1);
  return unpack_space(record.data, reference, &base.space);
}

}  // namespace

ProportionsRecord proportions_record(const Skeleton& skeleton, const TakeLayout& layout,
                                     double frame_rate, bool frame_rate_assumed) {
  ProportionsRecord record;
  record.millimetres_per_unit = skeleton.millimetres_per_unit;
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

Skeleton reference_skeleton(const ArchiveStore& store, std::int64_t skeleton) {
  const SkeletonRecord record = store.skeleton(skeleton);
  return *skeleton_of(store.reference_proportions(skeleton), record.format);
}

CodedSpace read_space(const ArchiveStore& store, std::int64_t id) {
  return read_space(store, id, 0);
}

}  // namespace reprise
