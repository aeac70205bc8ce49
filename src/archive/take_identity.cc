#include "archive/take_identity.h"

#include <cmath>

#include "reprise/error.h"
#include "store/digest.h"

namespace reprise {
namespace {

/// Reads and digests; the digest is of what was read, so that a file that changes in between is
/// noticed.
SourceTake read_with_digest(const InputFile& file, const ReadOptions& options,
                            std::string& digest) {
  std::string text = read_whole_file(file.path);
  const std::string name = file.path.string();
  if (begins_as_archive(text)) {
    throw Error(ErrorCode::rejected_input, "this is a Reprise archive, not a motion file", {name},
                "reprise extract takes motion out of it");
  }
  // A folder is searched by the same names: verify would not find the source of another.
  const std::optional<MotionFormat> format = motion_format_of(file.path);
  if (!format) {
    throw Error(ErrorCode::rejected_input, "the name ends neither in .bvh nor in .amc", {name},
                "only BVH and ASF/AMC are read");
  }
  Hasher hasher;
  hasher.add(text);
  Take take;
  if (format == MotionFormat::asf_amc) {
    const std::filesystem::path asf = asf_of(file.path, options);
    const std::string asf_text = read_whole_file(asf);
    hasher.add(asf_text);
    auto skeleton = std::make_shared<Skeleton>(read_asf(asf_text, asf.string()));
    skeleton->asf_name = asf.stem().string();
    take = read_amc(text, name, std::move(skeleton), options.frame_rate, options.partial);
  } else {
    take = read_bvh(text, name,
                    options.bvh_millimetres_per_unit.value_or(default_millimetres_per_unit),
                    options.frame_rate, options.partial);
  }
  digest = hexadecimal(hasher.finish());
  take.name = file.name;
  for (Eigen::Index i = 0; i < take.channels.size(); ++i) {
    if (!std::isfinite(take.channels.data()[i])) {
      throw Error(ErrorCode::rejected_input, "a value is not a finite number", {name},
                  "mend it, or leave it out");
    }
  }
  return {std::move(take), std::move(text)};
}

}  // namespace

TakeOutline outline_take(const InputFile& file, const ReadOptions& options) {
  TakeOutline outline;
  const auto [take, text] = read_with_digest(file, options, outline.source_digest);
  outline.subject = take.skeleton->asf_name.empty() ? file.folder : take.skeleton->asf_name;
  outline.text_bytes = text.size();
  if (take.frames() == 0) {
    throw Error(ErrorCode::rejected_input, "the file has no frames", {file.path.string()},
                "it is a skeleton alone: export it with its motion");
  }
  outline.content = content_digest(*take.skeleton, take.channels, 0, take.frames());
  outline.skeleton = take.skeleton;
  outline.evidence = layout_evidence(prepare_take(take));
  outline.reading_evidence = reading_evidence(take);
  outline.frames = take.frames();
  outline.frame_rate = take.frame_rate;
  outline.frame_rate_assumed = take.frame_rate_assumed;
  outline.layout = take.layout;
  outline.notes = take.notes;
  return outline;
}

void read_as(TakeOutline& outline, const TakeReading& reading) {
  outline.evidence.read_as(*outline.skeleton, reading.millimetres_per_unit, reading.up);
  outline.skeleton = read_as(*outline.skeleton, reading);
}

SourceTake read_source(const FreshTake& fresh, const ReadOptions& options) {
  std::string digest;
  SourceTake source = read_with_digest(fresh.file, options, digest);
  if (digest != fresh.outline.source_digest) {
    throw Error(ErrorCode::rejected_input, "the file changed while it was being read",
                {fresh.file.path.string()}, "run the ingest again");
  }
  // The same bytes are the same skeleton; how they are read was settled over all takes.
  source.take.skeleton = fresh.outline.skeleton;
  source.take.frame_rate = fresh.outline.frame_rate;
  source.take.frame_rate_assumed = fresh.outline.frame_rate_assumed;
  return source;
}

Take read_again(const FreshTake& fresh, const ReadOptions& options) {
  return read_source(fresh, options).take;
}

PreparedTake read_prepared(const FreshTake& fresh, const ReadOptions& options) {
  return prepare_take(read_again(fresh, options));
}

Digest content_digest(const Skeleton& skeleton, const ChannelMatrix& channels, long first,
                      long frames) {
  Hasher hasher;
  hasher.add(structure_bytes(skeleton));
  for (long f = first; f < first + frames; ++f) {
    for (Eigen::Index c = 0; c < channels.cols(); ++c) hasher.add_real(channels(f, c) + 0.0);
  }
  return hasher.finish();
}

std::uint64_t clip_address(const Digest& content) {
  std::uint64_t address = 0;
  for (int i = 0; i < 8; ++i) address = address << 8 | content[i];
  return address;
}

ClipRecord whole_take_clip(const Digest& content, long frames) {
  ClipRecord clip;
  clip.id = clip_address(content);
  clip.kind = ClipKind::unique;
  clip.frames = frames;
  return clip;
}

}  // namespace reprise
