// Postures of many takes, and from which distance on they are dissimilar.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "rma/clip_alignment.h"
#include "rma/postures.h"
#include "rma/repeat_constants.h"
#include "rma/similar_posture_paths.h"

namespace reprise {

/// Takes that share a skeleton: postures at RepeatConstants::rate, and the same projected.
struct PostureLibrary {
  std::vector<PostureMatrix> postures;
  std::vector<PostureMatrix> projected;
  /// Of each sample: the distance (mm) from which on a posture is dissimilar, and the same for
  /// postures of another subject.
  std::vector<std::vector<float>> similar_mm;
  std::vector<std::vector<float>> similar_across_mm;
  /// Of each take; empty where all distances have the same limits.
  std::vector<std::string> subjects;

  PostureLibrary() = default;
  /// All samples have the limits of RepeatConstants.
  PostureLibrary(std::vector<PostureMatrix> takes, const RepeatConstants& constants);

  /// Limits that follow each sample's reach (posture_reaches, RepeatConstants::reach_mm): what is
  /// similar depends on how far away other motion is. For libraries of many takes; in a single take
  /// that does one thing all is within reach. `jobs` threads, 0: one a core.
  void follow_reach(const RepeatConstants& constants, unsigned jobs = 1);

  std::size_t takes() const { return postures.size(); }
  bool of_one_subject(std::size_t take, std::size_t other) const;
  /// The limits of a take's samples for postures of another take.
  const std::vector<float>& similar(std::size_t take, std::size_t other) const;
  /// One side of the plot of `take` beside another.
  PlotSide side(std::size_t take, std::size_t other) const {
    return {projected[take], similar(take, other)};
  }
  PostureView view(std::size_t take, long begin, long end) const;
};

}  // namespace reprise
