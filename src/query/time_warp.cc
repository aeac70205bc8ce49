#include "query/time_warp.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

namespace reprise {
namespace {

enum class Step : std::uint8_t { both, row, column };

struct Reached {
  float cost = 0;
  int length = 0;
  Step step = Step::both;
};

/// The cheapest way to a place: from the one before it on both sides, above it and beside it (null
/// where there is none).
Reached reach(const Reached* both, const Reached* above, const Reached* beside, float cost) {
  Reached best = both ? *both : Reached{};
  bool found = both != nullptr;
  best.step = Step::both;
  if (above && (!found || above->cost < best.cost)) {
    best = {above->cost, above->length, Step::row};
    found = true;
  }
  if (beside && (!found || beside->cost < best.cost)) {
    best = {beside->cost, beside->length, Step::column};
  }
  best.cost += cost;
  ++best.length;
  return best;
}

}  // namespace

CostMatrix row_distances(const Eigen::Ref<const CostMatrix>& a,
                         const Eigen::Ref<const CostMatrix>& b) {
  CostMatrix costs = a * b.transpose();
  const Eigen::VectorXf squares_a = a.rowwise().squaredNorm();
  const Eigen::RowVectorXf squares_b = b.rowwise().squaredNorm();
  costs *= -2.0f;
  costs.colwise() += squares_a;
  costs.rowwise() += squares_b;
  costs = costs.cwiseMax(0.0f).cwiseSqrt();
  return costs;
}

double warped_cost(const CostMatrix& costs) {
  assert(costs.size() > 0);
  const long rows = costs.rows(), columns = costs.cols();
  std::vector<Reached> previous(static_cast<std::size_t>(columns)), current(previous);
  for (long i = 0; i < rows; ++i) {
    for (long j = 0; j < columns; ++j) {
      const auto at = static_cast<std::size_t>(j);
      current[at] =
          reach(i > 0 && j > 0 ? &previous[at - 1] : nullptr, i > 0 ? &previous[at] : nullptr,
                j > 0 ? &current[at - 1] : nullptr, costs(i, j));
    }
    std::swap(previous, current);
  }
  return double{previous.back().cost} / previous.back().length;
}

std::vector<std::pair<long, long>> warping_path(const CostMatrix& costs) {
  assert(costs.size() > 0);
  const long rows = costs.rows(), columns = costs.cols();
  std::vector<Reached> reached(static_cast<std::size_t>(costs.size()));
  const auto at = [&](long i, long j) {
    return &reached[static_cast<std::size_t>(i * columns + j)];
  };
  for (long i = 0; i < rows; ++i) {
    for (long j = 0; j < columns; ++j) {
      *at(i, j) = reach(i > 0 && j > 0 ? at(i - 1, j - 1) : nullptr, i > 0 ? at(i - 1, j) : nullptr,
                        j > 0 ? at(i, j - 1) : nullptr, costs(i, j));
    }
  }
  std::vector<std::pair<long, long>> path = {{rows - 1, columns - 1}};
  while (path.back() != std::pair<long, long>{0, 0}) {
    auto [i, j] = path.back();
    const Step step = at(i, j)->step;
    if (step != Step::column) --i;
    if (step != Step::row) --j;
    path.emplace_back(i, j);
  }
  std::reverse(path.begin(), path.end());
  return path;
}

ColumnRange best_fit(const CostMatrix& costs) {
  assert(costs.rows() > 0);
  const long rows = costs.rows(), columns = costs.cols();
  // Steps (1,1), (1,2) and (2,1): half to twice the speed. Every row counts once.
  struct Fit {
    float cost;
    long begin;
  };
  constexpr float never = 1e30f;
  std::vector<Fit> fits(static_cast<std::size_t>(rows * columns), {never, 0});
  const auto at = [&](long i, long j) -> Fit& {
    return fits[static_cast<std::size_t>(i * columns + j)];
  };
  for (long j = 0; j < columns; ++j) at(0, j) = {costs(0, j), j};
  for (long i = 1; i < rows; ++i) {
    for (long j = 1; j < columns; ++j) {
      Fit best = at(i - 1, j - 1);
      if (j > 1 && at(i - 1, j - 2).cost < best.cost) best = at(i - 1, j - 2);
      if (i > 1 && at(i - 2, j - 1).cost + costs(i - 1, j) < best.cost) {
        best = {at(i - 2, j - 1).cost + costs(i - 1, j), at(i - 2, j - 1).begin};
      }
      if (best.cost < never) at(i, j) = {best.cost + costs(i, j), best.begin};
    }
  }
  ColumnRange range{0, columns};
  float least = never;
  for (long j = 0; j < columns; ++j) {
    if (at(rows - 1, j).cost < least) {
      least = at(rows - 1, j).cost;
      range = {at(rows - 1, j).begin, j + 1};
    }
  }
  return range;
}

}  // namespace reprise
