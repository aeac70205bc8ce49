#include "query/candidate_windows.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "reprise/synth/library.h"

namespace reprise {
namespace {

using K = CandidateConstants;

PostureTrack synthetic_track() {
  SynthOptions options;
  options.takes = 1;
  options.seconds = 6;
  return posture_track(make_synthetic_library(options).takes[0]);
}

TEST(CandidateWindows, WhatIsLeftOutTakesNoPlaceOfWhatIsNot) {
  const PostureTrack track = synthetic_track();
  // As near as the last one and before it in every answer of the index.
  const std::vector<const PostureTrack*> tracks(K::neighbours + 2, &track);
  const CandidateWindows windows(tracks);
  std::vector<bool> accept(tracks.size(), false);
  accept.back() = true;
  const Stretch part{1, 3};
  const std::vector<Candidate> found = windows.find(track, part, 5, accept);
  ASSERT_FALSE(found.empty());
  double most_covered = 0;
  for (const Candidate& candidate : found) {
    EXPECT_EQ(candidate.track, tracks.size() - 1);
    most_covered = std::max(most_covered, covered(part, candidate.stretch));
  }
  EXPECT_GT(most_covered, 0.75);
}

TEST(CandidateWindows, WhereAllIsLeftOutNothingIsFound) {
  const PostureTrack track = synthetic_track();
  const CandidateWindows windows({&track, &track});
  EXPECT_TRUE(windows.find(track, {1, 3}, 5, {false, false}).empty());
}

}  // namespace
}  // namespace reprise
