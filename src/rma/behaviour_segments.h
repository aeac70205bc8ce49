// Where one behaviour of a take ends and the next begins (Barbic and others 2004, as lin-2011
// section 4.1 and liu-mcmillan-2006 use it).
#pragma once

#include <vector>

#include "rma/postures.h"

namespace reprise {

/// liu-mcmillan-2006 gives frames at 120 a second; they are times here.
struct SegmentConstants {
  double initial_s = 200.0 / 120;  ///< K0: what the first model is made of
  double test_s = 150.0 / 120;     ///< T: what is held against the model
  double step_s = 10.0 / 120;      ///< Delta: by which the model grows
  double variance_share = 0.95;    ///< tau: what the model's axes have to cover
  /// R: peak minus valley of the mean squared Mahalanobis distance. The paper's 500 is for angles;
  /// for postures on their leading axes this was measured
  /// (docs/findings/2026-11-25-behaviours.md).
  double least_rise = 200;
  /// Cuts of the two directions that are nearer than this are one (s). The papers leave it open;
  /// half of what separates two people's cuts of the same take.
  double same_cut_s = 0.5;
};

/// Cuts of a take, rising, at samples in (0, rows): a behaviour begins at each. `projected` are
/// postures on their principal axes. Forward and backward cuts united. A take shorter than
/// initial_s + test_s has none.
std::vector<long> behaviour_cuts(const PostureMatrix& projected, double rate,
                                 const SegmentConstants& constants = {});

}  // namespace reprise
