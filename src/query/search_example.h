// What a search looks for, and what it found in a take.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "query/candidate_windows.h"
#include "query/library_reach.h"
#include "query/motion_library.h"
#include "query/take_ranking.h"

namespace reprise {

struct Example {
  const PostureTrack* track = nullptr;
  Stretch stretch;
  bool whole = true;
  std::string name;  ///< of the archive's take, else empty
  std::string subject;
};

/// Not zero, for an example of a single frame.
double seconds_of(const Example& example);
/// From the first frame to the last.
Stretch whole_of(const PostureTrack& track);

/// A stretch that was compared in full.
struct Match {
  std::size_t take = 0;  ///< of the library
  Stretch stretch;
  double unlikeness = 0;
  std::optional<double> distance_mm{};  ///< mean_joint_distance to the example; of repeats at least
  bool repeat = false;                  ///< near enough to be a repeat of the example
};
/// Less unlike; equal ones are in the order of takes and times.
bool better(const Match& a, const Match& b);
/// The order of results: repeats by distance, then the rest by unlikeness.
bool comes_before(const Match& a, const Match& b);

/// Takes of one plan, and what is made for them when it is first needed.
struct PlanGroup {
  std::vector<std::size_t> takes;
  std::optional<TakeRanking> ranking;
  std::optional<CandidateWindows> windows;
  std::optional<LibraryReach> reach;
};
std::vector<const PostureTrack*> tracks_of(const std::vector<LibraryTake>& library,
                                           const PlanGroup& group);

}  // namespace reprise
