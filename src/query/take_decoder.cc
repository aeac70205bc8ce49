#include "query/take_decoder.h"

#include <fmt/format.h>

#include <algorithm>

#include "exact/text_codec.h"
#include "model/free_memory.h"
#include "model/written_channels.h"
#include "quant/take_codec.h"
#include "quant/take_header.h"
#include "refine/coarse_channels.h"
#include "refine/coded_channels.h"
#include "refine/refinement.h"
#include "reprise/error.h"

namespace reprise {
namespace {

/// In the file's units or degrees; a source has at most InputLimits::magnitude.
constexpr double greatest_channel = 1e12;
constexpr std::size_t decoding_bytes_per_number = 40;
/// What takes no more memory than that is decoded without a look at how much there is.
constexpr std::size_t always_there = std::size_t{256} << 20;

bool keeps(const LayerRecord& layer, FidelityTier tier) {
  switch (tier) {
    case FidelityTier::preview:
      return true;
    case FidelityTier::standard:
      return layer.kind == LayerKind::text || (layer.kind == LayerKind::refinement &&
                                               layer.limit_mm <= FidelityLimits::standard_mm &&
                                               layer.limit_deg <= FidelityLimits::standard_deg);
    case FidelityTier::fine:
      return layer.kind == LayerKind::text ||
             (layer.kind == LayerKind::refinement && layer.limit_mm <= FidelityLimits::fine_mm &&
              layer.limit_deg <= FidelityLimits::fine_deg);
    default:
      return layer.kind == LayerKind::text;
  }
}

/// The number of frames decides how much memory a decoder takes. It can be no more than the text
/// that the take is said to come from had room for, and that text no larger than texts may be.
void check_frames(const TakeInfo& take, const Skeleton& skeleton) {
  if (take.frames < 1) {
    throw Error(ErrorCode::damaged,
                "the archive is damaged: take '" + take.name + "' has no frames");
  }
  const auto channels = static_cast<std::uint64_t>(skeleton.channel_count);
  const std::uint64_t numbers =
      skeleton.format == MotionFormat::bvh ? channels : channels / InputLimits::channels_per_value;
  // Each has a digit, and a space or the end of the line after it.
  const std::uint64_t frame_bytes = std::max<std::uint64_t>(1, 2 * numbers);
  const auto frames = static_cast<std::uint64_t>(take.frames);
  if (take.text_bytes <= InputLimits::file_bytes && frames <= take.text_bytes / frame_bytes) {
    return;
  }
  throw Error(ErrorCode::damaged, "the archive is damaged: take '" + take.name +
                                      "' has more frames than a text can hold");
}

/// What can be told to be damaged is not called too large.
void check_memory(const StoredLayer& stored, const Skeleton& skeleton) {
  if (decoding_memory(skeleton, stored.take.frames) <= always_there) return;
  if (stored.kind == LayerKind::refinement || stored.kind == LayerKind::channels) {
    const SplitLayer split =
        split_header(skeleton, *stored.known, stored.take.frames, stored.bytes);
    const std::size_t moving = moving_count(split.header.constants);
    if (!channels_fit(split.data.size(), moving, stored.take.frames)) {
      throw Error(ErrorCode::damaged, "the archive is damaged: take '" + stored.take.name +
                                          "' has more frames than its bytes can hold");
    }
  }
  check_decoding_memory(stored.take, skeleton, free_memory());
}

/// What a BVH begins with is stored with its skeleton.
std::string known_text(const Take& take) {
  return take.skeleton->format == MotionFormat::bvh ? take.skeleton->source_text : std::string();
}

/// The source text, as long as it was: few coded bytes can be very many equal lines.
std::string decode_whole_text(std::span<const std::uint8_t> coded, const TakeInfo& info,
                              const Take& empty) {
  std::string text = decode_text(coded, known_text(empty), info.text_bytes);
  if (text.size() == info.text_bytes) return text;
  throw Error(ErrorCode::damaged, "the archive is damaged: the text of take '" + info.name +
                                      "' is not as long as it was");
}

ChannelMatrix parsed_channels(const Take& empty, const std::string& text, const std::string& name) {
  try {
    Take parsed =
        empty.skeleton->format == MotionFormat::bvh
            ? read_bvh(text, name, empty.skeleton->millimetres_per_unit, empty.frame_rate, true)
            : read_amc(text, name, empty.skeleton, empty.frame_rate, true);
    if (parsed.channels.cols() == empty.skeleton->channel_count) return std::move(parsed.channels);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::rejected_input && error.code() != ErrorCode::limit) throw;
  }
  throw Error(ErrorCode::damaged,
              "the archive is damaged: the text of take '" + name + "' is not what was taken in");
}

/// Channels of the prepared take.
ChannelMatrix prepared_channels(const StoredLayer& stored, const Skeleton& skeleton,
                                const SplitLayer& split) {
  const TakeInfo& info = stored.take;
  const TakeShape shape{prepared_frames(split.header, info.frames), info.frame_rate};
  const ChannelConstants& constants = split.header.constants;
  switch (stored.kind) {
    case LayerKind::coefficients:
      if (!same_structure(stored.space->space.layout.reference, skeleton)) {
        throw Error(ErrorCode::damaged, "the archive is damaged: the axes of take '" + info.name +
                                            "' are another skeleton's");
      }
      return decode_take(*stored.space, skeleton, constants, shape, split.data);
    case LayerKind::refinement:
      return decode_refinement(skeleton, constants, shape, split.data);
    case LayerKind::channels:
      return decode_coarse_channels(skeleton, constants, shape, split.data);
    case LayerKind::text:
      break;
  }
  throw Error(ErrorCode::damaged, "the archive is damaged: a layer is of no known kind");
}

ChannelMatrix channels_of(const StoredLayer& stored, const Take& empty, std::string* text) {
  const TakeInfo& info = stored.take;
  if (stored.kind == LayerKind::text) {
    std::string decoded = decode_whole_text(stored.bytes, info, empty);
    ChannelMatrix channels = parsed_channels(empty, decoded, info.name);
    if (text != nullptr) *text = std::move(decoded);
    return channels;
  }
  const Skeleton& skeleton = *empty.skeleton;
  const SplitLayer split = split_header(skeleton, *stored.known, info.frames, stored.bytes);
  return restore_take(skeleton, split.header, prepared_channels(stored, skeleton, split));
}

}  // namespace

std::size_t decoding_memory(const Skeleton& skeleton, long frames) {
  return static_cast<std::size_t>(frames) * decoding_bytes_per_number *
         static_cast<std::size_t>(skeleton.channel_count);
}

std::size_t decoding_memory(const TakeInfo& take) {
  return take.raw_bytes / sizeof(float) * decoding_bytes_per_number;
}

void check_decoding_memory(const TakeInfo& take, const Skeleton& skeleton, std::size_t free) {
  constexpr std::size_t megabyte = 1'000'000;
  const std::size_t needed = decoding_memory(skeleton, take.frames);
  if (needed <= free) return;
  throw Error(ErrorCode::limit,
              fmt::format("decoding take '{}' of {} frames needs about {} MB of memory, and {} MB "
                          "are free: decode it on a machine that has more",
                          take.name, take.frames, needed / megabyte, free / megabyte));
}

std::size_t layer_for(const TakeRecord& take, std::optional<FidelityTier> tier) {
  if (!tier) return take.layers.size() - 1;
  for (std::size_t i = 0; i < take.layers.size(); ++i) {
    if (keeps(take.layers[i], *tier)) return i;
  }
  throw Error(ErrorCode::usage, take.info.name + " is stored as " +
                                    tier_name(take.info.fidelity.tier) +
                                    "; it cannot be extracted as " + tier_name(*tier));
}

StoredLayer read_layer(OpenArchive& archive, const TakeRecord& record, std::size_t layer) {
  const LayerKind kind = record.layers[layer].kind;
  const std::size_t channels = archive.store.skeleton(record.info.skeleton).channels;
  return {record.info,
          kind,
          archive.store.layer(record.info.id, layer),
          archive.proportions(record.proportions),
          kind == LayerKind::coefficients ? &archive.space(record.space) : nullptr,
          kind == LayerKind::text ? nullptr : &archive.known_values(record.space, channels)};
}

Take decode_layer(const StoredLayer& stored, std::string* text) {
  Take take = empty_take(stored.proportions, stored.take.format);
  take.name = stored.take.name;
  check_frames(stored.take, *take.skeleton);
  check_memory(stored, *take.skeleton);
  take.channels = channels_of(stored, take, text);
  clear_unwritten_channels(*take.skeleton, take.layout, take.channels);
  if (take.frames() != stored.take.frames) {
    throw Error(ErrorCode::damaged, "the archive is damaged: take '" + take.name +
                                        "' has another number of frames than was stored");
  }
  // Whoever measures or sorts what comes out counts on this. A NaN fails it, too.
  if (!(take.channels.array().abs() <= greatest_channel).all()) {
    throw Error(ErrorCode::damaged, "the archive is damaged: take '" + take.name +
                                        "' decodes to numbers that no motion has");
  }
  return take;
}

Take decode_layer(OpenArchive& archive, const TakeRecord& record, std::size_t layer,
                  std::string* text) {
  return decode_layer(read_layer(archive, record, layer), text);
}

std::string decode_source_text(OpenArchive& archive, const TakeRecord& record) {
  const std::size_t layer = layer_for(record, FidelityTier::exact);
  const Take empty = empty_take(archive.proportions(record.proportions), record.info.format);
  return decode_whole_text(archive.store.layer(record.info.id, layer), record.info, empty);
}

}  // namespace reprise
