// One take of a planned library.
#pragma once

#include <memory>

#include "synth/plan.h"
#include "synth/poses.h"

namespace reprise::synth {

/// A person: body, habits and the skeleton that is written.
struct Subject {
  Proportions body;
  Posture posture;
  GaitStyle walk;
  GaitStyle run;
  std::shared_ptr<const Skeleton> skeleton;
};

Subject make_subject(const SynthOptions& options, const std::string& name, std::size_t index);

/// Where a planned occurrence came to be.
struct MadeOccurrence {
  std::size_t motif = 0;
  std::size_t place = 0;
  SynthOccurrence occurrence;
};

struct MadeTake {
  Take take;
  std::vector<MadeOccurrence> occurrences;
};

/// Take `index` of the plan; independent of all others.
MadeTake make_take(const SynthOptions& options, const LibraryPlan& plan, std::size_t index,
                   const Subject& subject);

}  // namespace reprise::synth
