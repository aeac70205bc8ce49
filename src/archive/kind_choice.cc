#include "archive/kind_choice.h"

#include <algorithm>
#include <limits>

#include "quant/cosine_transform.h"

namespace reprise {

void add_scales(const CoefficientSpace& space, const TakeCurves& curves, KnotScales& scales) {
  for (const CurveKind kind : {CurveKind::nested_knots, CurveKind::cosines}) {
    if (kind == CurveKind::cosines && curves.shape.frames > most_cosine_frames) continue;
    const TakeKnots knots =
        take_knots(space, curves.shape, curves.tumbles, curves.trajectories, {kind, kind});
    scales.add(knots.shape, knots.knots);
  }
}

void KindCosts::add(const KindCosts& take, double weight) {
  for (std::size_t i = 0; i < bits.size(); ++i) bits[i] += weight * take.bits[i];
}

KnotScales KindCosts::cheapest(const KnotScales& scales) const {
  KnotScales best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < choices.size(); ++i) {
    KnotScales some = scales;
    some.keep(choices[i]);
    const double all = bits[i] + 8.0 * static_cast<double>(KnotModel(some).prior(false).size());
    if (i > 0 && all >= least) continue;
    least = all;
    best = std::move(some);
  }
  return best;
}

KindCosts kind_costs(const CoefficientSpace& space, const KnotModel& model,
                     const TakeCurves& curves, int step_index) {
  KindCosts costs;
  costs.bits.fill(std::numeric_limits<double>::infinity());
  for (const CurveKinds pair : possible_kinds(model, curves.shape.frames)) {
    const TakeKnots knots =
        take_knots(space, curves.shape, curves.tumbles, curves.trajectories, pair);
    const double cost = quantise(model, knots, step_index).cost;
    for (std::size_t i = 0; i < costs.bits.size(); ++i) {
      const auto has = [&](CurveKind kind) {
        return KindCosts::choices[i][static_cast<std::size_t>(kind)];
      };
      if (has(pair.coefficients) && has(pair.root)) costs.bits[i] = std::min(costs.bits[i], cost);
    }
  }
  return costs;
}

}  // namespace reprise
