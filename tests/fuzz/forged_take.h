// A take of the sample and what it needs, with changes that a forger may make.
#pragma once

#include <vector>

#include "fuzz/fuzz_input.h"
#include "store/archive_store.h"

namespace reprise {

/// A take and what it needs, as they are in the sample.
struct Forged {
  SkeletonRecord skeleton;
  ProportionsRecord proportions;
  SpaceRecord space;
  TakeRecord take;
  std::vector<ClipRecord> clips;
};

/// Changes one of its parts: something is always changed. An edit takes a few bytes of the input.
void edit(Forged& forged, FuzzInput& input);

/// Makes right what the store would not take, or what would be refused for that alone: the digest
/// of the structure that the skeleton's text now has, clips that cover the take.
void mend(Forged& forged);

}  // namespace reprise
