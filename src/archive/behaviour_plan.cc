#include "archive/behaviour_plan.h"

#include <algorithm>
#include <cmath>

namespace reprise {

SegmentShape BehaviourPlan::shape_of(const Segment& segment) const {
  return segment_shape(
      library_.projected[segment.take].middleRows(segment.begin, segment.end - segment.begin));
}

/// Neighbouring clips of one group are one segment.
std::vector<BehaviourPlan::Segment> BehaviourPlan::stored_segments() const {
  std::vector<Segment> segments;
  for (std::size_t take = 0; take < stored_.size(); ++take) {
    const std::vector<ClipInfo>& clips = stored_[take].clips;
    const long rows = library_.postures[take].rows();
    const double seconds = stored_[take].take.seconds();
    for (std::size_t c = 0; c < clips.size(); ++c) {
      const auto sample = [&](double at) {
        return std::clamp(std::lround(at / seconds * static_cast<double>(rows)), 0L, rows);
      };
      const long begin = sample(clips[c].start), end = sample(clips[c].end);
      if (begin >= end || clips[c].group == 0) continue;
      const bool goes_on = c > 0 && clips[c - 1].group == clips[c].group && !segments.empty() &&
                           segments.back().take == take;
      if (goes_on) {
        segments.back().end = end;
      } else {
        segments.push_back({take, begin, end, clips[c].group});
      }
    }
  }
  return segments;
}

void BehaviourPlan::group_new_segments(std::int64_t& next_group) {
  std::vector<SegmentShape> shapes;
  for (std::size_t take = stored_.size(); take < library_.takes(); ++take) {
    std::vector<long> borders = cuts_[take];
    borders.insert(borders.begin(), 0);
    borders.push_back(library_.postures[take].rows());
    for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
      segments_.push_back({take, borders[i], borders[i + 1], 0});
      shapes.push_back(shape_of(segments_.back()));
    }
  }
  std::vector<KnownSegment> known;
  for (const Segment& segment : stored_segments())
    known.push_back({shape_of(segment), segment.group});
  const std::vector<std::int64_t> groups = join_groups(shapes, known, next_group);
  for (std::size_t s = 0; s < segments_.size(); ++s) {
    segments_[s].group = groups[s];
    next_group = std::max(next_group, groups[s] + 1);
  }
}

std::int64_t BehaviourPlan::group_at(const ChosenClip& clip) const {
  std::int64_t group = 0;
  long most = 0;
  const auto first = std::ranges::lower_bound(segments_, clip.take, {}, &Segment::take);
  for (auto at = first; at != segments_.end() && at->take == clip.take; ++at) {
    const long common = std::min(at->end, clip.end) - std::max(at->begin, clip.begin);
    if (common > most) {
      most = common;
      group = at->group;
    }
  }
  return group;
}

std::vector<std::int64_t> BehaviourPlan::groups_of(const std::vector<ChosenClip>& clips,
                                                   std::int64_t& next_group) {
  group_new_segments(next_group);
  std::vector<std::int64_t> groups(clips.size(), 0);
  std::size_t index = 0;
  for (std::size_t c = 0; c < clips.size(); ++c) {
    index = c > 0 && clips[c].take == clips[c - 1].take ? index + 1 : 0;
    groups[c] = clips[c].take < stored_.size() ? stored_[clips[c].take].clips[index].group
                                               : group_at(clips[c]);
  }
  for (std::size_t c = 0; c < clips.size(); ++c) {
    if (clips[c].take >= stored_.size() && clips[c].role == ClipRole::repeated)
      groups[c] = groups[clips[c].primary];
  }
  return groups;
}

}  // namespace reprise
