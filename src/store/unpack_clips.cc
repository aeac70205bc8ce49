// The clips of a block of takes out of its columns.
#include "store/unpack_clips.h"

#include <utility>

namespace reprise {
namespace {

constexpr std::int64_t most_step = std::int64_t{1} << 61;  ///< from a take to another

/// Each clip has an address further on, so that counts cannot claim more than there is.
void unpack_clip_counts(std::vector<StoredTake>& takes, ColumnReader& reader) {
  const std::vector<std::uint64_t> counts = reader.numbers(takes.size());
  std::uint64_t left = reader.left() / sizeof(StoredClip::address);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    takes[i].clips.resize(checked<std::size_t>(counts[i], left));
    left -= counts[i];
  }
}

void unpack_primaries(std::vector<StoredTake>& takes, ColumnReader& reader) {
  std::vector<std::pair<StoredTake*, StoredClip*>> repeated;
  for (StoredTake& take : takes) {
    for (StoredClip& clip : take.clips) {
      if (clip.kind == ClipKind::repeated) repeated.emplace_back(&take, &clip);
    }
  }
  const std::vector<std::uint64_t> takes_of = reader.numbers(repeated.size());
  const std::vector<std::uint64_t> indices = reader.numbers(repeated.size());
  for (std::size_t i = 0; i < repeated.size(); ++i) {
    const std::int64_t step = unfolded(takes_of[i]);
    if (step > most_step || step < -most_step) throw_damaged_block();
    repeated[i].second->primary = {repeated[i].first->record.info.id + step,
                                   checked<std::size_t>(indices[i], most_frames)};
  }
}

}  // namespace

void unpack_clips(std::vector<StoredTake>& takes, ColumnReader& reader) {
  TakeColumns all(takes, reader);
  unpack_clip_counts(takes, reader);
  const auto count = [](const StoredTake& t) { return t.clips.size(); };
  all.columns(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
    const auto kind = checked<ClipKind>(v, static_cast<std::uint64_t>(ClipKind::unique));
    if (kind < ClipKind::primary) throw_damaged_block();
    t.clips[i].kind = kind;
  });
  all.columns(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
    t.clips[i].group = checked<std::int64_t>(v, most_id);
  });
  const auto but_one = [](const StoredTake& t) { return t.clips.empty() ? 0 : t.clips.size() - 1; };
  all.columns(but_one, [](StoredTake& t, std::size_t i, std::uint64_t v) {
    t.clips[i].frames = checked<long>(v, most_frames);
  });
  unpack_primaries(takes, reader);
  for (StoredTake& take : takes) {
    long left = take.record.info.frames;
    for (StoredClip& clip : take.clips) {
      for (const std::uint8_t byte : reader.raw(sizeof clip.address))
        clip.address = clip.address << 8 | byte;
      if (&clip == &take.clips.back()) clip.frames = left;
      if (clip.frames > left) throw_damaged_block();
      left -= clip.frames;
    }
  }
}

}  // namespace reprise
