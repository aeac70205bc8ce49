// Behaviour groups for the clips of an ingest.
#pragma once

#include <cstdint>
#include <vector>

#include "archive/stored_motion.h"
#include "rma/behaviour_groups.h"
#include "rma/behaviour_segments.h"
#include "rma/clip_choice.h"

namespace reprise {

class BehaviourPlan {
 public:
  /// `library` holds the stored takes and then new ones, `cuts` the behaviour cuts of those.
  BehaviourPlan(const PostureLibrary& library, const std::vector<StoredMotion>& stored,
                const std::vector<std::vector<long>>& cuts)
      : library_(library), stored_(stored), cuts_(cuts) {}

  /// The group of each clip: of a stored one its own; of a repeated one its primary's; of others
  /// that of the behaviour that has the most of it. New groups are counted from `next_group` on.
  std::vector<std::int64_t> groups_of(const std::vector<ChosenClip>& clips,
                                      std::int64_t& next_group);

 private:
  struct Segment {
    std::size_t take = 0;
    long begin = 0;
    long end = 0;
    std::int64_t group = 0;
  };
  std::vector<Segment> stored_segments() const;
  SegmentShape shape_of(const Segment& segment) const;
  void group_new_segments(std::int64_t& next_group);
  std::int64_t group_at(const ChosenClip& clip) const;

  const PostureLibrary& library_;
  const std::vector<StoredMotion>& stored_;
  const std::vector<std::vector<long>>& cuts_;
  std::vector<Segment> segments_;  ///< of new takes, in order
};

}  // namespace reprise
