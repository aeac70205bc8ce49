#include "rma/clip_cover.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace reprise {
namespace {

/// The clips of a take by time, as their places in `clips`.
std::vector<std::size_t> places_of(std::size_t take, const std::vector<ChosenClip>& clips) {
  std::vector<std::size_t> places;
  for (std::size_t c = 0; c < clips.size(); ++c) {
    if (clips[c].take == take) places.push_back(c);
  }
  std::ranges::sort(places, {}, [&](std::size_t c) { return clips[c].begin; });
  return places;
}

/// Samples of a take that no clip has, and the clips beside them.
struct Gap {
  std::size_t take = 0;
  long begin = 0;
  long end = 0;
  ChosenClip* before = nullptr;
  ChosenClip* after = nullptr;
};

bool can_grow(const ChosenClip* clip) {
  return clip != nullptr && clip->role == ClipRole::repeated;
}

void fill(const Gap& gap, long least, std::vector<ChosenClip>& fresh) {
  const long length = gap.end - gap.begin;
  if (length < least && can_grow(gap.before)) {
    ChosenClip& clip = *gap.before;
    clip.reference.resize(static_cast<std::size_t>(gap.end - clip.begin), clip.reference.back());
    clip.end = gap.end;
  } else if (length < least && can_grow(gap.after)) {
    ChosenClip& clip = *gap.after;
    clip.reference.insert(clip.reference.begin(), static_cast<std::size_t>(length),
                          clip.reference.front());
    clip.begin = gap.begin;
  } else {
    fresh.push_back({gap.take, gap.begin, gap.end, ClipRole::unique, 0, {}});
  }
}

/// By take and time, with the indices of primaries brought along.
std::vector<ChosenClip> in_order(std::vector<ChosenClip> clips) {
  std::vector<std::size_t> order(clips.size()), place(clips.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {},
                    [&](std::size_t c) { return std::tuple(clips[c].take, clips[c].begin); });
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  std::vector<ChosenClip> ordered;
  for (const std::size_t c : order) {
    ordered.push_back(std::move(clips[c]));
    ChosenClip& clip = ordered.back();
    if (clip.role == ClipRole::repeated) clip.primary = place[clip.primary];
  }
  return ordered;
}

}  // namespace

std::vector<ChosenClip> cover_takes(std::vector<ChosenClip> clips, std::span<const long> samples,
                                    long least) {
  std::vector<ChosenClip> fresh;
  for (std::size_t take = 0; take < samples.size(); ++take) {
    Gap gap{take, 0, 0, nullptr, nullptr};
    for (const std::size_t c : places_of(take, clips)) {
      gap.after = &clips[c];
      gap.end = clips[c].begin;
      if (gap.end > gap.begin) fill(gap, least, fresh);
      gap.before = gap.after;
      gap.begin = clips[c].end;
    }
    gap.after = nullptr;
    gap.end = samples[take];
    if (gap.end > gap.begin) fill(gap, least, fresh);
  }
  std::ranges::move(fresh, std::back_inserter(clips));
  return in_order(std::move(clips));
}

}  // namespace reprise
