// Candidates for repeated motion from an index over short windows, so that a library needs no
// self-distance plot of all of its frames.
#pragma once

#include <optional>
#include <vector>

#include "rma/repeat_groups.h"

namespace reprise {

struct NearWindowConstants {
  /// Length of a window at its take's own speed (s), and from one to the next (s).
  double window_s = 0.5;
  double hop_s = 0.2;
  /// Postures that stand for a window.
  int postures = 5;
  /// Numbers of a window that are kept, on principal axes of all windows.
  int dimensions = 12;
  /// A window looks for this many others of each speed; for more where those of one take alone are
  /// asked for, as no others find it then.
  std::size_t neighbours = 8;
  std::size_t neighbours_of_one_take = 24;
  /// They may be this many times as far as those that are nearest (WindowIndex::nearly_nearest).
  double excess = 2;
  /// Parts of the tree that a search for them looks into at most: what it costs does not grow with
  /// the library from some hundred takes on. Measured
  /// (docs/findings/2026-11-25-repeated-motion.md).
  long most_looks = 150;
  /// and no further than this (root mean square joint distance, mm), or than this in proportion
  /// where postures further than RepeatConstants::similar_mm are similar.
  float most_mm = 70;
};

/// Pairs of places whose windows are alike at some speed from 1/2 to 2, nearest first. A window is
/// not paired with one that overlaps it. With `only_take` just the pairs that its windows find.
/// `jobs` threads, 0: one a core; the pairs do not depend on it.
std::vector<NearPair> find_near_pairs(const PostureLibrary& library, const RepeatConstants& repeats,
                                      std::optional<std::size_t> only_take = std::nullopt,
                                      unsigned jobs = 1, const NearWindowConstants& constants = {});

}  // namespace reprise
