#include "archive/clip_plan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "archive/behaviour_plan.h"
#include "archive/parallel.h"
#include "archive/stored_motion.h"
#include "query/near_windows.h"
#include "rma/clip_choice.h"

namespace reprise {
namespace {

/// Samples of a take as frames: the first and the last sample are where the take begins and ends.
long frame_at(long sample, long samples, const TakeOutline& take, double rate) {
  if (sample >= samples) return take.frames;
  const double frame = static_cast<double>(sample) / rate * take.frame_rate;
  return std::clamp(std::lround(frame), 0L, take.frames);
}

/// The takes of one skeleton: those that are stored, with their clips, and then the new ones.
class SkeletonPlanner {
 public:
  SkeletonPlanner(std::vector<StoredMotion> stored, std::vector<const FreshTake*> fresh,
                  const ClipPlanConstants& constants, unsigned jobs)
      : stored_(std::move(stored)), fresh_(std::move(fresh)), constants_(constants), jobs_(jobs) {}

  /// `bodies` of the new takes, in their order. Groups are counted from `next_group` on.
  void plan(std::vector<MovingBody> bodies, std::int64_t& next_group, ClipPlan& plan) {
    std::vector<PostureMatrix> postures;
    std::vector<double> sizes;
    for (StoredMotion& motion : stored_) {
      postures.push_back(std::move(motion.body.postures));
      sizes.push_back(motion.body.size);
    }
    for (std::size_t take = 0; take < bodies.size(); ++take) {
      postures.push_back(std::move(bodies[take].postures));
      sizes.push_back(bodies[take].size);
    }
    bring_to_median_size(postures, sizes);
    library_ = PostureLibrary(std::move(postures), repeats_);
    library_.follow_reach(repeats_, jobs_);
    choose();
    divide();
    assign_groups(next_group);
    write(plan);
  }

 private:
  bool is_new(std::size_t take) const { return take >= stored_.size(); }

  /// Stored clips as samples; the last one ends where the take does. The primary of a repeated one
  /// whose primary is in none of the takes is itself.
  std::vector<ChosenClip> standing_clips() const {
    std::vector<ChosenClip> standing;
    std::map<ClipId, std::size_t> primaries;
    for (std::size_t take = 0; take < stored_.size(); ++take) {
      const StoredMotion& motion = stored_[take];
      const long rows = library_.postures[take].rows();
      for (const ClipInfo& clip : motion.clips) {
        const bool last = &clip == &motion.clips.back();
        const auto sample = [&](double seconds) {
          return std::clamp(std::lround(seconds * repeats_.rate), 0L, rows);
        };
        const ClipRole role = clip.kind == ClipKind::primary    ? ClipRole::primary
                              : clip.kind == ClipKind::repeated ? ClipRole::repeated
                                                                : ClipRole::unique;
        if (role == ClipRole::primary) primaries.emplace(clip.id, standing.size());
        standing.push_back(
            {take, sample(clip.start), last ? rows : sample(clip.end), role, standing.size(), {}});
      }
    }
    std::size_t next = 0;
    for (const StoredMotion& motion : stored_) {
      for (const ClipInfo& clip : motion.clips) {
        ChosenClip& chosen = standing[next++];
        const auto primary = primaries.find(clip.primary);
        if (chosen.role == ClipRole::repeated && primary != primaries.end())
          chosen.primary = primary->second;
      }
    }
    return standing;
  }

  void choose() {
    const auto pairs = find_near_pairs(library_, repeats_, std::nullopt, jobs_);
    const std::vector<ChosenClip> standing = standing_clips();
    const long least = std::lround(repeats_.least_clip_s * repeats_.rate);
    std::vector<Occurrence> references;
    for (const ChosenClip& clip : standing) {
      if (clip.role != ClipRole::repeated && clip.end - clip.begin >= least)
        references.push_back({clip.take, clip.begin, clip.end, 0});
    }
    std::vector<RepeatGroup> groups = find_groups_of(library_, pairs, references, repeats_, jobs_);
    std::ranges::move(find_groups_from(library_, pairs, stored_.size(), repeats_, jobs_),
                      std::back_inserter(groups));
    ClipChoiceConstants choice;
    choice.least_s = constants_.least_rest_s;
    choice.least_repeated_s = repeats_.least_clip_s;
    choice.least_primary_s = repeats_.least_clip_s;
    clips_ = choose_clips(library_, groups, repeats_, choice, standing);
  }

  /// Cuts unique clips of new takes where behaviours meet. Others keep together what recurs.
  void divide() {
    const long least = std::lround(constants_.least_part_s * repeats_.rate);
    cuts_.resize(library_.takes());
    for (std::size_t take = stored_.size(); take < library_.takes(); ++take)
      cuts_[take] = behaviour_cuts(library_.projected[take], repeats_.rate);
    std::vector<ChosenClip> divided;
    std::vector<std::size_t> place(clips_.size());
    for (std::size_t c = 0; c < clips_.size(); ++c) {
      ChosenClip clip = clips_[c];
      if (is_new(clip.take) && clip.role == ClipRole::unique) {
        for (const long cut : cuts_[clip.take]) {
          if (cut - clip.begin < least || clip.end - cut < least) continue;
          divided.push_back({clip.take, clip.begin, cut, ClipRole::unique, 0, {}});
          clip.begin = cut;
        }
      }
      place[c] = divided.size();
      divided.push_back(std::move(clip));
    }
    for (ChosenClip& clip : divided) {
      if (clip.role == ClipRole::repeated) clip.primary = place[clip.primary];
    }
    clips_ = std::move(divided);
  }

  void assign_groups(std::int64_t& next_group) {
    groups_ = BehaviourPlan(library_, stored_, cuts_).groups_of(clips_, next_group);
  }

  void write(ClipPlan& plan) const {
    std::vector<std::size_t> index(clips_.size(), 0);
    for (std::size_t c = 1; c < clips_.size(); ++c)
      index[c] = clips_[c].take == clips_[c - 1].take ? index[c - 1] + 1 : 0;
    const auto place_of = [&](std::size_t c) {
      const std::size_t take = clips_[c].take;
      const std::string& name =
          is_new(take) ? fresh_[take - stored_.size()]->file.name : stored_[take].take.name;
      return PlannedPlace{name, index[c]};
    };
    for (std::size_t c = 0; c < clips_.size(); ++c) {
      const ChosenClip& clip = clips_[c];
      if (!is_new(clip.take)) continue;
      const TakeOutline& take = fresh_[clip.take - stored_.size()]->outline;
      const long rows = library_.postures[clip.take].rows();
      PlannedClip planned;
      planned.first_frame = frame_at(clip.begin, rows, take, repeats_.rate);
      planned.frames = frame_at(clip.end, rows, take, repeats_.rate) - planned.first_frame;
      planned.group = groups_[c];
      planned.kind = clip.role == ClipRole::primary    ? ClipKind::primary
                     : clip.role == ClipRole::repeated ? ClipKind::repeated
                                                       : ClipKind::unique;
      if (clip.role == ClipRole::repeated) planned.primary = place_of(clip.primary);
      plan.takes[fresh_[clip.take - stored_.size()]->file.name].push_back(std::move(planned));
    }
  }

  std::vector<StoredMotion> stored_;
  std::vector<const FreshTake*> fresh_;
  const ClipPlanConstants& constants_;
  RepeatConstants repeats_;
  unsigned jobs_;
  PostureLibrary library_;
  std::vector<ChosenClip> clips_;
  std::vector<std::vector<long>> cuts_;  ///< behaviour cuts of new takes
  std::vector<std::int64_t> groups_;     ///< of each clip
};

}  // namespace

ClipPlan plan_clips(const std::filesystem::path& archive, const std::vector<FreshTake>& takes,
                    const std::map<std::string, SpaceAssignment>& spaces,
                    const IngestOptions& options,
                    const std::function<void(const std::string&)>& tick) {
  const ClipPlanConstants constants;
  const RepeatConstants repeats;
  StoredMotionReader stored(archive, takes);
  std::int64_t next_group = stored.greatest_group() + 1;
  // Skeletons in the order of their first takes.
  std::vector<std::pair<std::int64_t, std::vector<const FreshTake*>>> skeletons;
  for (const FreshTake& fresh : takes) {
    const std::int64_t skeleton = stored.skeleton_of(spaces.at(fresh.file.name).proportions);
    auto known = std::ranges::find(skeletons, skeleton, [](const auto& s) { return s.first; });
    if (known == skeletons.end()) known = skeletons.insert(skeletons.end(), {skeleton, {}});
    known->second.push_back(&fresh);
  }
  ClipPlan plan;
  for (const auto& [skeleton, fresh_takes] : skeletons) {
    const auto& fresh = fresh_takes;  // clang 14 lets no lambda use a binding
    const RootAxis root = stored.root_of(skeleton);
    std::vector<MovingBody> bodies;
    produce_in_order(
        fresh.size(), options.jobs,
        [&](std::size_t i) {
          return moving_body(read_again(*fresh[i], options.read), root, repeats.rate);
        },
        [&](std::size_t i, MovingBody own) {
          bodies.push_back(std::move(own));
          tick(fresh[i]->file.name);
        });
    const std::size_t most_stored =
        std::min(constants.most_stored_takes, constants.stored_takes_per_new * fresh.size());
    SkeletonPlanner planner(stored.motions(skeleton, root, repeats.rate, most_stored), fresh,
                            constants, options.jobs);
    planner.plan(std::move(bodies), next_group, plan);
  }
  return plan;
}

}  // namespace reprise
