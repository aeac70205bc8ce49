#include "rma/repeat_groups.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "rma/clip_extents.h"
#include "rma/parallel_for.h"
#include "rma/posture_reach.h"

namespace reprise {
namespace {

/// A clip that shares this much with a member of a group is explained by the group.
constexpr double explained_overlap = 0.7;

/// A stretch of a take that is to be looked at.
struct Stretch {
  std::size_t take = 0;
  long begin = 0;
  long end = 0;
};

/// A stretch around one place that is near to a place of a clip.
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

  std::vector<Stretch> stretches_near(const Occurrence& clip) const;

  const PostureLibrary& library_;
  const RepeatConstants& constants_;
  unsigned jobs_;
  std::vector<std::vector<NearPair>> near_;                  ///< by take, each pair from both sides
  std::vector<std::vector<std::pair<long, long>>> members_;  ///< of all groups, by take
  std::vector<std::vector<int>> times_told_;  ///< of each sample: in how many groups it is
};

bool moves(const PostureView& clip, const RepeatConstants& constants) {
  const long steps = clip.postures.rows() - 1;
  double sum = 0;
  for (long s = 0; s < steps; ++s) {
    sum += mean_joint_distance(clip.postures.row(s).data(), clip.postures.row(s + 1).data(),
                               clip.postures.cols());
  }
  return steps > 0 &&
         sum / static_cast<double>(steps) * constants.rate >= constants.least_speed_mm_s;
}

/// RepeatConstants::member_mm, less where the clip's postures have to be nearer to postures of a
/// take to be similar.
float narrowed_member_mm(const PostureLibrary& library, const Occurrence& clip, std::size_t take,
                         const RepeatConstants& constants) {
  const auto similar = library.similar(clip.take, take).begin();
  const float sum = std::accumulate(similar + clip.begin, similar + clip.end, 0.0F);
  const float mean = sum / static_cast<float>(clip.end - clip.begin);
  return constants.member_mm * mean / constants.similar_mm;
}

/// The part of it that counts for a clip of this many samples.
float length_share(long samples, const RepeatConstants& constants) {
  const double shortest = constants.least_path_s,
               seconds = static_cast<double>(samples) / constants.rate;
  const double part =
      std::clamp((seconds - shortest) / (constants.whole_clip_s - shortest), 0.0, 1.0);
  return constants.short_share + (1 - constants.short_share) * static_cast<float>(part);
}

/// Of a take: the mean joint distance (mm) to a clip up to which something in it repeats the clip.
using MemberLimit = std::function<float(std::size_t take)>;

/// What is like the clip in a stretch and does not overlap it.
std::vector<Occurrence> members_in(const PostureLibrary& library, const Occurrence& clip,
                                   const PostureView& view, const Stretch& stretch,
                                   const MemberLimit& most_mm, const RepeatConstants& constants) {
  const auto found = align_clip(view, library.view(stretch.take, stretch.begin, stretch.end),
                                most_mm(stretch.take));
  const long least = std::lround(constants.least_clip_s * constants.rate);
  std::vector<Occurrence> members;
  for (const AlignedClip& member : found) {
    const long begin = stretch.begin + member.begin, end = stretch.begin + member.end;
    if (end - begin < least) continue;
    if (stretch.take == clip.take && begin < clip.end && clip.begin < end) continue;
    Occurrence occurrence{stretch.take, begin, end, member.mean_mm, member.map};
    for (long& sample : occurrence.map) sample += stretch.begin;
    members.push_back(std::move(occurrence));
  }
  return members;
}

/// Adds what is like the clip in any of the stretches, in their order.
void add_members(const PostureLibrary& library, const Occurrence& clip, const PostureView& view,
                 const std::vector<Stretch>& stretches, const MemberLimit& most_mm,
                 const RepeatConstants& constants, unsigned jobs, RepeatGroup& group) {
  // A thread costs as much as some alignments.
  constexpr std::size_t least_stretches = 16;
  std::vector<std::vector<Occurrence>> members(stretches.size());
  parallel_for(stretches.size(), stretches.size() < least_stretches ? 1 : jobs, [&](std::size_t s) {
    members[s] = members_in(library, clip, view, stretches[s], most_mm, constants);
  });
  for (auto& list : members) std::ranges::move(list, std::back_inserter(group.occurrences));
}

std::vector<Stretch> GroupFinder::stretches_near(const Occurrence& clip) const {
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
  std::vector<Stretch> stretches;
  for (auto& [take, parts] : reached) {
    std::ranges::sort(parts, {}, [](const ReachedPart& p) { return std::pair(p.begin, p.end); });
    for (std::size_t p = 0; p < parts.size();) {
      Stretch stretch{take, parts[p].begin, parts[p].end};
      std::set<long> places;
      for (; p < parts.size() && parts[p].begin <= stretch.end; ++p) {
        stretch.end = std::max(stretch.end, parts[p].end);
        places.insert(parts[p].from);
      }
      if (static_cast<long>(places.size()) >= least_places) stretches.push_back(stretch);
    }
  }
  return stretches;
}

RepeatGroup GroupFinder::members_of(const Occurrence& clip) const {
  RepeatGroup group{{clip}};
  const PostureView view = library_.view(clip.take, clip.begin, clip.end);
  if (!moves(view, constants_)) return group;
  const float share = length_share(clip.end - clip.begin, constants_);
  const MemberLimit most_mm = [&](std::size_t take) {
    return share * narrowed_member_mm(library_, clip, take, constants_);
  };
  add_members(library_, clip, view, stretches_near(clip), most_mm, constants_, jobs_, group);
  return group;
}

}  // namespace

PostureLibrary::PostureLibrary(std::vector<PostureMatrix> takes, const RepeatConstants& constants)
    : postures(std::move(takes)) {
  const PostureBasis basis(postures, constants.axes);
  for (const PostureMatrix& take : postures) {
    projected.push_back(basis.project(take));
    similar_mm.emplace_back(static_cast<std::size_t>(take.rows()), constants.similar_mm);
    similar_across_mm.emplace_back(static_cast<std::size_t>(take.rows()),
                                   constants.across_subjects * constants.similar_mm);
  }
}

void PostureLibrary::narrow_to_reach(const RepeatConstants& constants) {
  constexpr float least_mm = 1;  // distances are divided by it
  const auto reaches = posture_reaches(projected, constants.reach_part);
  for (std::size_t take = 0; take < takes(); ++take) {
    for (auto* similar : {&similar_mm[take], &similar_across_mm[take]}) {
      for (std::size_t s = 0; s < similar->size(); ++s) {
        (*similar)[s] =
            std::clamp(constants.reach_share * reaches[take][s], least_mm, (*similar)[s]);
      }
    }
  }
}

bool PostureLibrary::of_one_subject(std::size_t take, std::size_t other) const {
  return subjects.empty() || subjects[take] == subjects[other];
}

const std::vector<float>& PostureLibrary::similar(std::size_t take, std::size_t other) const {
  return of_one_subject(take, other) ? similar_mm[take] : similar_across_mm[take];
}

PostureView PostureLibrary::view(std::size_t take, long begin, long end) const {
  return {postures[take].middleRows(begin, end - begin),
          projected[take].middleRows(begin, end - begin)};
}

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
  std::vector<Stretch> takes;
  for (std::size_t take = 0; take < library.takes(); ++take) {
    takes.push_back({take, 0, library.postures[take].rows()});
  }
  const MemberLimit most_mm = [&](std::size_t take) {
    const float widest = library.of_one_subject(clip.take, take)
                             ? constants.member_mm
                             : constants.across_subjects * constants.member_mm;
    return std::min(widest,
                    constants.asked_share * narrowed_member_mm(library, clip, take, constants));
  };
  add_members(library, clip, library.view(clip.take, clip.begin, clip.end), takes, most_mm,
              constants, jobs, group);
  return group;
}

}  // namespace reprise
