#include "archive/clip_links.h"

#include <algorithm>
#include <set>

namespace reprise {
namespace {

class ClipLinker {
 public:
  ClipLinker(ArchiveStore& store, const ClipPlan& plan, const std::set<std::string>& added)
      : store_(store), plan_(plan), added_(added) {}

  std::map<std::int64_t, std::vector<ClipRecord>> changes() {
    for (const auto& [name, clips] : plan_.takes) link_take(name, clips);
    for (const ClipPlace& place : repeated_)
      changes_.at(place.take)[place.index].kind = ClipKind::primary;
    return std::move(changes_);
  }

 private:
  /// The clips of a stored take; null where there is none of that name.
  std::vector<ClipRecord>* clips_of(std::int64_t take) {
    if (take == 0) return nullptr;
    const auto known = changes_.find(take);
    if (known != changes_.end()) return &known->second;
    const std::int64_t ids[] = {take};
    return &changes_.emplace(take, store_.clips(ids)).first->second;
  }

  /// 0 where there is none. A take that was to be stored and was not may have a namesake.
  std::int64_t id_of(const std::string& name) {
    if (plan_.takes.contains(name) && !added_.contains(name)) return 0;
    const auto known = ids_.find(name);
    if (known != ids_.end()) return known->second;
    const auto take = store_.find_take(name);
    return ids_[name] = take ? take->info.id : 0;
  }

  void link_take(const std::string& name, const std::vector<PlannedClip>& planned) {
    const auto repeats = [](const PlannedClip& clip) { return clip.kind == ClipKind::repeated; };
    if (std::ranges::none_of(planned, repeats)) return;
    const std::int64_t take = id_of(name);
    if (take == 0) return;
    for (std::size_t c = 0; c < planned.size(); ++c) {
      if (!repeats(planned[c])) continue;
      const ClipPlace primary{id_of(planned[c].primary.take), planned[c].primary.index};
      if (clips_of(primary.take) == nullptr) continue;
      repeated_.insert(primary);
      ClipRecord& clip = clips_of(take)->at(c);
      clip.kind = ClipKind::repeated;
      clip.primary_place = primary;
    }
  }

  ArchiveStore& store_;
  const ClipPlan& plan_;
  const std::set<std::string>& added_;
  std::map<std::string, std::int64_t> ids_;
  std::map<std::int64_t, std::vector<ClipRecord>> changes_;
  std::set<ClipPlace> repeated_;
};

}  // namespace

void link_clips(ArchiveStore& store, const ClipPlan& plan, const std::set<std::string>& added) {
  const auto changes = ClipLinker(store, plan, added).changes();
  if (changes.empty()) return;
  store.begin();
  store.set_clips(changes);
  store.commit();
}

}  // namespace reprise
