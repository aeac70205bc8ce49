// Where motion recurs in an archive.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "query/archive_impl.h"
#include "query/near_windows.h"
#include "query/skeleton_postures.h"
#include "reprise/error.h"
#include "store/digest.h"

namespace reprise {
namespace {

/// The stored clip of a take that holds the most of some frames.
class StoredClips {
 public:
  explicit StoredClips(const Archive& archive) {
    for (ClipInfo& clip : archive.clips()) clips_[clip.take].push_back(std::move(clip));
  }

  ClipId holding(const std::string& take, double start, double end) const {
    const auto known = clips_.find(take);
    if (known == clips_.end()) return {};
    const auto common = [&](const ClipInfo& c) {
      return std::min(c.end, end) - std::max(c.start, start);
    };
    return std::ranges::max_element(known->second, {}, common)->id;
  }

 private:
  std::map<std::string, std::vector<ClipInfo>> clips_;
};

std::string group_id(const TakeInfo& take, const Occurrence& reference) {
  Hasher hasher;
  hasher.add_text(take.name);
  hasher.add_text(take.source_digest);
  hasher.add_number(reference.begin);
  hasher.add_number(reference.end);
  return hexadecimal(shortened(hasher.finish()));
}

/// The whole frame nearest to a sample.
long frame_at(const TakeInfo& take, long sample, double rate) {
  const double frame = static_cast<double>(sample) / rate * take.frame_rate;
  return std::clamp(std::lround(frame), 0L, take.frames);
}

/// The samples that frames cover.
Occurrence clip_of(std::size_t take, const TakeInfo& info, FrameRange frames, long samples,
                   double rate) {
  const auto sample_at = [&](long frame) {
    return std::lround(static_cast<double>(frame) / info.frame_rate * rate);
  };
  const long end = std::min(sample_at(frames.end), samples);
  return {take, std::min(sample_at(frames.begin), end), end, 0};
}

class RepeatsReader {
 public:
  RepeatsReader(const Archive& archive, const RepeatQuery& query)
      : query_(query), clips_(archive) {}

  void add_groups_of(const SkeletonPostures& postures) {
    const std::optional<std::size_t> only = position_of_take(postures.takes);
    if (query_.take && !only) return;
    if (query_.frames) {
      add(postures, repeats_of_part(postures, *only));
      return;
    }
    const auto pairs = find_near_pairs(postures.library, constants_, only, query_.jobs);
    for (const RepeatGroup& group :
         find_repeat_groups(postures.library, pairs, only, constants_, query_.jobs)) {
      add(postures, group);
    }
  }

  std::vector<RecurringMotion> finish() { return std::move(found_); }

  const RepeatConstants& constants() const { return constants_; }

 private:
  std::optional<std::size_t> position_of_take(const std::vector<TakeInfo>& takes) const {
    if (!query_.take) return std::nullopt;
    const auto at = std::ranges::find(takes, query_.take->name, &TakeInfo::name);
    if (at == takes.end()) return std::nullopt;
    return static_cast<std::size_t>(at - takes.begin());
  }

  RepeatGroup repeats_of_part(const SkeletonPostures& postures, std::size_t take) const {
    constexpr long least_samples = 3;
    const Occurrence clip = clip_of(take, postures.takes[take], *query_.frames,
                                    postures.library.postures[take].rows(), constants_.rate);
    if (clip.end - clip.begin < least_samples) {
      throw Error(ErrorCode::usage, "the part is too short to look for its motion");
    }
    return find_repeats_of(postures.library, clip, constants_, query_.jobs);
  }

  void add(const SkeletonPostures& postures, const RepeatGroup& group) {
    RecurringMotion motion;
    std::set<std::string> subjects;
    bool of_take = !query_.take;
    for (const Occurrence& occurrence : group.occurrences) {
      MotionOccurrence told = describe(postures.takes[occurrence.take], occurrence);
      const bool reference = motion.occurrences.empty();
      if (!reference) {
        told.distance_mm = own_size_distance(postures, group.occurrences[0], occurrence);
      }
      if (reference && query_.frames) {
        told.start = static_cast<double>(query_.frames->begin) / query_.take->frame_rate;
        told.end = static_cast<double>(query_.frames->end) / query_.take->frame_rate;
      }
      if (told.end - told.start < query_.least_seconds) {
        if (reference) return;
        continue;
      }
      of_take |= query_.take && query_.take->name == told.take;
      subjects.insert(told.subject);
      motion.occurrences.push_back(std::move(told));
    }
    if (!of_take || motion.occurrences.size() < 2) return;
    if (query_.across_subjects && subjects.size() < 2) return;
    motion.id = group_id(postures.takes[group.occurrences[0].take], group.occurrences[0]);
    found_.push_back(std::move(motion));
  }

  MotionOccurrence describe(const TakeInfo& take, const Occurrence& occurrence) const {
    MotionOccurrence told;
    told.take = take.name;
    told.subject = take.subject;
    told.start =
        static_cast<double>(frame_at(take, occurrence.begin, constants_.rate)) / take.frame_rate;
    told.end =
        static_cast<double>(frame_at(take, occurrence.end, constants_.rate)) / take.frame_rate;
    told.distance_mm = occurrence.distance_mm;
    told.clip = clips_.holding(take.name, told.start, told.end);
    return told;
  }

  const RepeatQuery& query_;
  StoredClips clips_;
  RepeatConstants constants_;
  std::vector<RecurringMotion> found_;
};

}  // namespace

std::vector<RecurringMotion> Archive::repeats(const RepeatQuery& query,
                                              const ProgressSink& progress) const {
  std::optional<ArchiveStore::Snapshot> snapshot = impl_->snapshot();
  std::map<std::int64_t, std::vector<TakeInfo>> by_skeleton;
  std::size_t done = 0, total = 0;
  for (TakeInfo& take : takes()) {
    if (query.take && take.skeleton != query.take->skeleton) continue;
    by_skeleton[take.skeleton].push_back(std::move(take));
    ++total;
  }
  const auto tick = [&](const TakeInfo& take) {
    if (progress && !progress({done++, total, take.name})) {
      throw Error(ErrorCode::interrupted, "stopped");
    }
  };
  RepeatsReader reader(*this, query);
  std::vector<SkeletonPostures> postures;
  for (auto& [skeleton, takes_of_skeleton] : by_skeleton) {
    const std::vector<std::int64_t> spaces = impl_->store.spaces_of_skeleton(skeleton);
    if (spaces.empty()) continue;
    const LayoutChoices& choices = impl_->space(spaces.front()).space.layout.choices;
    postures.push_back(read_postures(*impl_, std::move(takes_of_skeleton),
                                     {choices.root_joint, choices.up_axis}, reader.constants(),
                                     query.jobs, tick));
  }
  snapshot.reset();  // a writer need not wait for the comparing
  for (SkeletonPostures& of_skeleton : postures) {
    if (query.across_subjects) {
      for (const TakeInfo& take : of_skeleton.takes)
        of_skeleton.library.subjects.push_back(take.subject);
    }
    reader.add_groups_of(of_skeleton);
  }
  return reader.finish();
}

}  // namespace reprise
