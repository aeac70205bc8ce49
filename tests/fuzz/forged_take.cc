#include "fuzz/forged_take.h"

#include <bit>

#include "fuzz/edited_bytes.h"
#include "reprise/error.h"
#include "reprise/formats/motion_file.h"
#include "store/digest.h"
#include "store/take_block.h"

namespace reprise {
namespace {

double real(FuzzInput& input) { return std::bit_cast<double>(input.number(8)); }

/// A number in place of another one; what was meant to be changed is.
template <class Number>
void change(Number& number, Number to) {
  number = to == number ? number + 1 : to;
}

void change(UpAxis& axis, UpAxis to) {
  axis = to == axis ? static_cast<UpAxis>(static_cast<int>(axis) + 1) : to;
}

/// One of the kinds from 1 to `count`, but not this one.
template <class Kind>
void change_kind(Kind& kind, std::size_t count, FuzzInput& input) {
  const auto now = static_cast<std::size_t>(kind) - 1;
  kind = static_cast<Kind>(1 + (now + 1 + input.choice(count - 1)) % count);
}

void edit_take(TakeRecord& take, FuzzInput& input) {
  LayerRecord& layer = take.layers[input.choice(take.layers.size())];
  switch (input.choice(9)) {
    case 0:
      edit(layer.data, input);
      break;
    case 1:
      change_kind(layer.kind, 4, input);
      break;
    case 2:
      change(layer.limit_mm, real(input));
      break;
    case 3:
      change(take.info.frames, static_cast<long>(input.number(4)));
      break;
    case 4:
      change(take.info.text_bytes, input.number(6));
      break;
    case 5:
      take.info.fidelity.tier = static_cast<FidelityTier>(input.number(1));
      change(take.info.fidelity.limit_mm, real(input));
      break;
    case 6:
      change(layer.limit_deg, real(input));
      break;
    case 7:
      take.info.worst_turn.joint = static_cast<int>(input.number(2));
      change(take.info.worst_turn.frame, static_cast<long>(input.number(4)));
      break;
    default:
      edit(take.error_quantiles, input);
  }
}

void edit_proportions(Forged& forged, FuzzInput& input) {
  ProportionsRecord& record = forged.proportions;
  switch (input.choice(7)) {
    case 0:
      edit(record.layout, input);
      break;
    case 1:
      edit(record.asf_name, input);
      break;
    case 2:
      change(record.frame_rate, real(input));
      break;
    case 3:
      change(record.millimetres_per_unit, real(input));
      break;
    case 4:
      change(record.up, static_cast<UpAxis>(input.number(1)));
      break;
    default:
      edit(record.source_text, input);
  }
}

void edit_clips(std::vector<ClipRecord>& clips, FuzzInput& input) {
  ClipRecord& clip = clips[input.choice(clips.size())];
  switch (input.choice(4)) {
    case 0:
      // The last one has what is left.
      if (&clip != &clips.back()) {
        change(clip.frames, static_cast<long>(input.number(2)));
        break;
      }
      [[fallthrough]];
    case 1:
      change(clip.group, static_cast<std::int64_t>(input.number(7)));
      break;
    case 2:
      change_kind(clip.kind, 3, input);
      break;
    default:
      clips.push_back(ClipRecord(clip));
  }
}

/// The structure that the skeleton's text now has, so that it is not refused for that alone.
void mend_structure(Forged& forged) {
  try {
    const std::string& text = forged.proportions.source_text;
    const Skeleton skeleton = forged.skeleton.format == MotionFormat::bvh
                                  ? read_bvh_skeleton(text, "forged")
                                  : read_asf(text, "forged");
    forged.skeleton.structure = digest_of(structure_bytes(skeleton));
    forged.skeleton.joints = skeleton.joints.size();
    forged.skeleton.channels = static_cast<std::size_t>(skeleton.channel_count);
  } catch (const Error&) {
    // It stays what it was, and the text is refused.
  }
}

/// What a caller of the store sees to: clips follow one another and cover the take, and a sketch is
/// no longer than one may be.
void mend_take(Forged& forged) {
  long first = 0;
  for (ClipRecord& clip : forged.clips) {
    const long left = forged.take.info.frames - first;
    const bool last = &clip == &forged.clips.back();
    clip.first_frame = first;
    clip.frames = last ? left : std::min(clip.frames, left);
    first += clip.frames;
  }
  Bytes& sketch = forged.take.error_quantiles;
  sketch.resize(std::min(sketch.size(), TakeBlockLimits::quantiles));
}

}  // namespace

void edit(Forged& forged, FuzzInput& input) {
  switch (input.choice(4)) {
    case 0:
      return edit_take(forged.take, input);
    case 1:
      return edit_proportions(forged, input);
    case 2:
      // A take whose channels are coded as they are has no axes.
      if (forged.take.space != 0) return edit(forged.space.data, input);
      return edit_take(forged.take, input);
    default:
      edit_clips(forged.clips, input);
  }
}

void mend(Forged& forged) {
  mend_structure(forged);
  mend_take(forged);
}

}  // namespace reprise
