// Learns spaces from takes: axes, and where the contexts of their coder start.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "archive/kind_choice.h"
#include "archive/take_fit.h"
#include "archive/take_identity.h"

namespace reprise {

class SpaceTrainer {
 public:
  /// Indices of takes of one skeleton structure, by name.
  using Members = std::vector<std::size_t>;

  /// Keeps references to the takes and options. `tick` hears of each take that was fitted,
  /// and without a name of each that was only looked at: it may throw, to stop.
  SpaceTrainer(const std::vector<FreshTake>& takes, const IngestOptions& options,
               std::function<void(const std::string&)> tick)
      : takes_(takes), options_(options), tick_(std::move(tick)) {}

  /// A space for a skeleton's takes, packed (pack_space).
  Bytes train(const Skeleton& reference, const Members& members);

  /// What `base` lacks for takes that do not fit it, packed; empty where further axes do not help.
  Bytes extend(const CodedSpace& base, const Members& unfit);

  /// Takes that were fitted to the last of these spaces on the way, each by its index.
  std::map<std::size_t, FittedTake> take_fits() { return std::exchange(fits_, {}); }

 private:
  MarkerMoments moments_of(const MarkerLayout& layout, const Members& members,
                           bool every_frame) const;
  /// What the coder learns from some of the `training` takes, where that pays for `all` takes.
  std::vector<std::uint8_t> train_prior(const CoefficientSpace& space, const Members& training,
                                        std::size_t all);
  /// How finely the axes of a space from `known` on, and its mean, are stored for takes.
  SpacePrecision precision_for(const CoefficientSpace& space, Eigen::Index known,
                               const Members& members) const;
  /// What the curves of takes are like, and what they cost where each stands for `takes_each`.
  struct MeasuredCurves {
    KnotScales scales;
    KindCosts costs;
  };
  MeasuredCurves measure_curves(const CoefficientSpace& space, const Members& members,
                                double takes_each) const;
  /// Some of `members`, evenly spread, with about that many frames; one at least.
  Members some_of(const Members& members, long most_frames) const;
  long frames_of(const Members& members) const;
  std::vector<std::uint8_t> cheaper_prior(const KnotScales& scales, double takes_each) const;

  const std::vector<FreshTake>& takes_;
  const IngestOptions& options_;
  std::function<void(const std::string&)> tick_;
  std::map<std::size_t, FittedTake> fits_;
};

}  // namespace reprise
