#include "rma/repeat_groups.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "rma/clip_extents.h"

namespace reprise {
namespace {

/// A clip that shares this much with a member of a group is explained by the group.
constexpr double explained_overlap = 0.7;

/// A part around one place that is near to a place of a clip.
struct ReachedPart {
  long begin = 0;
  long end = 0;
  long from = 0;  ///< the place of the clip
};

class GroupFinder {
 public:
  GroupFinder(const PostureLibrary& library, std::span<const NearPair> near_pairs,
              const RepeatConstants& constants, unsigned jobs)
      : library_(library),
        constants_(constants),
        jobs_(jobs),
        near_(library.takes()),
        members_(library.takes()) {
    for (const PostureMatrix& take : library.postures) {
      times_told_.emplace_back(static_cast<std::size_t>(take.rows()), 0);
    }
    for (const NearPair& pair : near_pairs) {
      near_[pair.take].push_back(pair);
      near_[pair.other_take].push_back(
          {pair.other_take, pair.other_sample, pair.take, pair.sample});
    }
    for (auto& near : near_) std::sort(near.begin(), near.end());
  }

  std::vector<RepeatGroup> run(const std::vector<ClipExtent>& extents) {
    std::vector<RepeatGroup> groups;
    for (const ClipExtent& extent : extents) {
      if (is_explained(extent)) continue;
      RepeatGroup group = group_around({extent.take, extent.begin, extent.end, 0});
      if (group.occurrences.size() < 2) continue;
      for (const Occurrence& o : group.occurrences) add_explained(o);
      groups.push_back(std::move(group));
    }
    return groups;
  }

  /// A clip and what repeats it.
  RepeatGroup members_of(const Occurrence& clip) const;

 private:
  void add_explained(const Occurrence& member) {
    members_[member.take].push_back({member.begin, member.end});
    const auto told = times_told_[member.take].begin();
    std::for_each(told + member.begin, told + member.end, [](int& times) { ++times; });
  }

  bool is_explained(const ClipExtent& extent) const {
    const auto told = times_told_[extent.take].begin();
    const auto known = std::count_if(told + extent.begin, told + extent.end, [&](int times) {
      return times >= constants_.explained_times;
    });
    if (static_cast<double>(known) >=
        constants_.explained_cover * static_cast<double>(extent.end - extent.begin)) {
      return true;
    }
    return std::ranges::any_of(members_[extent.take], [&](const auto& member) {
      return overlap_ratio(extent.begin, extent.end, member.first, member.second) >=
             explained_overlap;
    });
  }

  /// The group of a clip, and then that of its member of median length: it is within reach of the
  /// fastest and of the slowest. The larger one is kept.
  RepeatGroup group_around(const Occurrence& clip) const {
    RepeatGroup group = members_of(clip);
    if (group.occurrences.size() < 3) return group;
    std::vector<Occurrence> by_length = group.occurrences;
    const auto middle = by_length.begin() + static_cast<std::ptrdiff_t>(by_length.size() / 2);
    std::nth_element(by_length.begin(), middle, by_length.end(),
                     [](const Occurrence& a, const Occurrence& b) {
                       return std::tuple(a.end - a.begin, a.take, a.begin) <
                              std::tuple(b.end - b.begin, b.take, b.begin);
                     });
    RepeatGroup other = members_of({middle->take, middle->begin, middle->end, 0});
    return other.occurrences.size() > group.occurrences.size() ? other : group;
  }

  std::vector<SearchedPart> parts_near(const Occurrence& clip) const;

  const PostureLibrary& library_;
  const RepeatConstants& constants_;
  unsigned jobs_;
  std::vector<std::vector<NearPair>> near_;                  ///< by take, each pair from both sides
  std::vector<std::vector<std::pair<long, long>>> members_;  ///< of all groups, by take
  std::vector<std::vector<int>> times_told_;  ///< of each sample: in how many groups it is
};

std::vector<SearchedPart> GroupFinder::parts_near(const Occurrence& clip) const {
  std::map<std::size_t, std::vector<ReachedPart>> reached;
  const long length = clip.end - clip.begin;
  const long reach = RepeatConstants::steepest * length;
  const auto& near = near_[clip.take];
  const auto first = std::ranges::lower_bound(near, clip.begin, {}, &NearPair::sample);
  for (auto at = first; at != near.end() && at->sample < clip.end; ++at) {
    const long rows = library_.postures[at->other_take].rows();
    reached[at->other_take].push_back({std::max(0L, at->other_sample - reach),
                                       std::min(rows, at->other_sample + reach), at->sample});
  }
  const auto least_places =
      std::lround(constants_.least_near_per_s / constants_.rate * static_cast<double>(length));
  std::vector<SearchedPart> searched;
  for (auto& [take, parts] : reached) {
    std::ranges::sort(parts, {}, [](const ReachedPart& p) { return std::pair(p.begin, p.end); });
    for (std::size_t p = 0; p < parts.size();) {
      SearchedPart part{take, parts[p].begin, parts[p].end};
      std::set<long> places;
      for (; p < parts.size() && parts[p].begin <= part.end; ++p) {
        part.end = std::max(part.end, parts[p].end);
        places.insert(parts[p].from);
      }
      if (static_cast<long>(places.size()) >= least_places) searched.push_back(part);
    }
  }
  return searched;
}

RepeatGroup GroupFinder::members_of(const Occurrence& clip) const {
  RepeatGroup group{{clip}};
  if (!moves(library_.view(clip.take, clip.begin, clip.end), constants_)) return group;
  std::ranges::move(find_members(library_, clip, parts_near(clip),
                                 group_limit(library_, clip, constants_), constants_, jobs_),
                    std::back_inserter(group.occurrences));
  return group;
}

}  // namespace

std::vector<RepeatGroup> find_repeat_groups(const PostureLibrary& library,
                                            std::span<const NearPair> near_pairs,
                                            std::optional<std::size_t> only_take,
                                            const RepeatConstants& constants, unsigned jobs) {
  std::vector<ClipExtent> extents = find_clip_extents(library, near_pairs, constants, jobs);
  if (only_take) {
    std::erase_if(extents, [&](const ClipExtent& extent) { return extent.take != *only_take; });
  }
  return GroupFinder(library, near_pairs, constants, jobs).run(extents);
}

std::vector<RepeatGroup> find_groups_from(const PostureLibrary& library,
                                          std::span<const NearPair> near_pairs,
                                          std::size_t first_take, const RepeatConstants& constants,
                                          unsigned jobs) {
  std::vector<ClipExtent> extents = find_clip_extents(library, near_pairs, constants, jobs);
  std::erase_if(extents, [&](const ClipExtent& extent) { return extent.take < first_take; });
  return GroupFinder(library, near_pairs, constants, jobs).run(extents);
}

std::vector<RepeatGroup> find_groups_of(const PostureLibrary& library,
                                        std::span<const NearPair> near_pairs,
                                        std::span<const Occurrence> clips,
                                        const RepeatConstants& constants, unsigned jobs) {
  const GroupFinder finder(library, near_pairs, constants, jobs);
  std::vector<RepeatGroup> groups;
  for (const Occurrence& clip : clips) {
    RepeatGroup group = finder.members_of(clip);
    if (group.occurrences.size() > 1) groups.push_back(std::move(group));
  }
  return groups;
}

RepeatGroup find_repeats_of(const PostureLibrary& library, const Occurrence& clip,
                            const RepeatConstants& constants, unsigned jobs) {
  RepeatGroup group{{clip}};
  group.occurrences[0].distance_mm = 0;
  std::vector<SearchedPart> takes;
  for (std::size_t take = 0; take < library.takes(); ++take) {
    takes.push_back({take, 0, library.postures[take].rows()});
  }
  std::ranges::move(
      find_members(library, clip, takes, asked_limit(library, clip, constants), constants, jobs),
      std::back_inserter(group.occurrences));
  return group;
}

}  // namespace reprise
