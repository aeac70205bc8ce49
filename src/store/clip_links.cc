// Which clips repeat which, when takes go.
#include <algorithm>

#include "reprise/error.h"
#include "store/store_impl.h"

namespace reprise {
namespace {

std::map<ClipPlace, std::set<std::int64_t>> all_links(const ArchiveStore::Impl& impl) {
  std::map<ClipPlace, std::set<std::int64_t>> links;
  impl.for_each_block([&](const TakeBlock& block) {
    for (const StoredTake& take : block.takes) {
      for (const StoredClip& clip : take.clips) {
        if (clip.kind == ClipKind::repeated) links[clip.primary].insert(block.id_of(take));
      }
    }
  });
  return links;
}

}  // namespace

StoredClip ArchiveStore::primary_of(const ClipRecord& clip) const {
  const ClipPlace& place = clip.primary_place;
  const auto block = impl_->block(block_of(place.take));
  const StoredTake* take = block ? block->find(place.take) : nullptr;
  if (take == nullptr || place.index >= take->clips.size() ||
      take->clips[place.index].kind != ClipKind::primary) {
    throw Error(ErrorCode::damaged, "the archive is damaged: a clip repeats one that is not there");
  }
  return take->clips[place.index];
}

void ArchiveStore::unlink_take(std::int64_t id) {
  if (!impl_->links) impl_->links = all_links(*impl_);
  auto& links = *impl_->links;
  std::map<std::int64_t, std::vector<ClipRecord>> changes;
  const auto clips_to_change = [&](std::int64_t take) -> std::vector<ClipRecord>& {
    const auto known = changes.find(take);
    if (known != changes.end()) return known->second;
    const std::int64_t ids[] = {take};
    return changes.emplace(take, clips(ids)).first->second;
  };
  const auto no_longer_repeats = [&](std::int64_t take) {
    for (ClipRecord& clip : clips_to_change(take)) {
      const bool gone = take == id || clip.primary_place.take == id;
      if (clip.kind == ClipKind::repeated && gone) clip.kind = ClipKind::unique;
    }
  };
  for (auto link = links.begin(); link != links.end();) {
    const auto& [primary, takes] = *link;
    if (primary.take == id) {
      std::ranges::for_each(takes, no_longer_repeats);
      link = links.erase(link);
      continue;
    }
    if (takes.contains(id)) {
      no_longer_repeats(id);
      link->second.erase(id);
      if (takes.empty()) {
        clips_to_change(primary.take)[primary.index].kind = ClipKind::unique;
        link = links.erase(link);
        continue;
      }
    }
    ++link;
  }
  if (!changes.empty()) change_clips(changes);
}

}  // namespace reprise
