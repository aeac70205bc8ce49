// Which motion recurs in which take: made for the whole library before any take is.
#pragma once

#include <string>
#include <vector>

#include "reprise/synth/library.h"
#include "synth/behaviours.h"

namespace reprise::synth {

/// A motion that recurs.
struct Motif {
  Behaviour behaviour = Behaviour::wave;
  std::uint64_t seed = 0;
  double seconds = 0;  ///< at speed 1
};

/// One occurrence of a motif.
struct PlannedOccurrence {
  std::size_t motif = 0;
  std::size_t place = 0;  ///< in the motif's list; 0 is the motif as it is
  double speed = 1;
  double noise = 0;
};

struct PlannedTake {
  std::string name;
  std::size_t subject = 0;
  double seconds = 0;  ///< to aim at
  std::vector<PlannedOccurrence> occurrences;
};

struct LibraryPlan {
  std::vector<Motif> motifs;
  std::vector<std::size_t> occurrence_counts;  ///< of each motif
  std::vector<PlannedTake> takes;
  std::vector<std::string> subjects;  ///< names
};

LibraryPlan plan_library(const SynthOptions& options);

/// The motif's own performance.
Performance perform_motif(const Motif& motif, double most_seconds);

/// The longest motif of a library whose takes have this mean length; 0 where they are too short for
/// any.
double longest_motif(const SynthOptions& options);

}  // namespace reprise::synth
