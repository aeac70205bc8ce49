#include "quant/knot_contexts.h"

#include <algorithm>
#include <array>

namespace reprise {
namespace {

/// How many bits a counter counts as having seen at its start.
constexpr int start_count = 2;
/// Decisions from this one on start alike.
constexpr std::uint32_t last_class = 3;
constexpr std::uint32_t classes = last_class + 1;

/// A logit (1/256 nat) is the sum of these, each times its feature: 1, two or three bins, then what
/// the table says. Fitted by logistic regression, each table on its own, to the decisions of takes
/// of 31, 22 and 100 joints, each set of takes with the same weight
/// (docs/findings/2026-11-25-preview-start.md).
constexpr int by_scale[classes][3] = {  // scale, scale^2 / 16
    {-1478, 200, -79},
    {-1317, 157, -47},
    {-939, 111, -23},
    {-550, 62, 5}};
constexpr int by_parents[classes][5] = {  // before, parents, before is 0, parents are 0
    {-377, 114, 28, -398, 186},
    {-705, 136, 36, 286, 265},
    {-527, 116, 26, 380, 252},
    {-423, 106, 25, 494, 298}};
constexpr int by_neighbours[classes][6] = {  // neighbours, before, parents, none, neither
    {-327, 83, 178, 11, -381, -75},
    {-632, 102, 106, 22, 179, 121},
    {-475, 85, 87, 13, 299, 173},
    {-295, 69, 75, 6, 339, 263}};
constexpr int by_sum[classes][6] = {  // half scale h, sum s, h s / 16, h^2 / 16, s is 0
    {-1168, 320, 3, 41, -311, -368},
    {-1177, 214, 30, -19, -101, 0},
    {-931, 157, 26, -13, -41, 70},
    {-700, 90, 27, -12, 44, 139}};
constexpr int by_column[classes] = {-319, -20, 174, 362};

/// All sixteenths at once, rounded down.
constexpr int with_sixteenths(int whole, int sixteenths) { return whole + (sixteenths >> 4); }

int logit_of(std::uint32_t table, std::uint32_t decision, std::uint32_t context) {
  const std::uint32_t k = std::min(decision, last_class);
  constexpr auto bins = static_cast<int>(KnotContexts::magnitudes);
  const auto c = static_cast<int>(context);
  if (table == 0) {
    const auto& w = by_scale[k];
    const int scale = c / static_cast<int>(KnotContexts::slots);
    return with_sixteenths(w[0] + w[1] * scale, w[2] * scale * scale);
  }
  const int before = c / bins % bins, parents = c % bins;
  if (table == 1) {
    const auto& w = by_parents[k];
    return w[0] + w[1] * before + w[2] * parents + w[3] * (before == 0) + w[4] * (parents == 0);
  }
  if (table == 2) {
    const auto& w = by_neighbours[k];
    const int beside = c / (bins * bins);
    return w[0] + w[1] * beside + w[2] * before + w[3] * parents + w[4] * (beside == 0) +
           w[5] * (before == 0 && parents == 0);
  }
  if (table == 3) {
    const auto& w = by_sum[k];
    constexpr auto sums = static_cast<int>(KnotContexts::fine_magnitudes);
    const int scale = c / sums, sum = c % sums;
    return with_sixteenths(w[0] + w[1] * scale + w[2] * sum + w[5] * (sum == 0),
                           w[3] * scale * sum + w[4] * scale * scale);
  }
  return by_column[k];
}

}  // namespace

void start_knot_counters(BitMixer& mixer) {
  for (std::uint32_t t = 0; t < BitModelConstants::inputs; ++t) {
    const std::uint32_t count = KnotContexts::count[t];
    for (std::uint32_t decision = 0; decision < sign_is_negative; ++decision) {
      for (std::uint32_t context = 0; context < count; ++context) {
        mixer.start(t, decision * count + context, logit_of(t, decision, context), start_count);
      }
    }
  }
}

}  // namespace reprise
