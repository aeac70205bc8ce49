#include "quant/knot_contexts.h"

#include <gtest/gtest.h>

#include <array>

namespace reprise {
namespace {

BitMixer started() {
  std::array<std::size_t, BitModelConstants::inputs> sizes;
  for (std::size_t t = 0; t < sizes.size(); ++t)
    sizes[t] = std::size_t{decision_count} * KnotContexts::count[t];
  BitMixer mixer(sizes, decision_count);
  start_knot_counters(mixer);
  return mixer;
}

/// Contexts in which a decision is made where all that they say is as small, or as large, as it can
/// be.
BitMixer::Contexts extreme(std::uint32_t decision, bool largest) {
  BitMixer::Contexts contexts;
  for (std::uint32_t t = 0; t < BitModelConstants::inputs; ++t) {
    const std::uint32_t count = KnotContexts::count[t];
    contexts.counter[t] = decision * count + (largest ? count - 1 : 0);
  }
  contexts.weights = decision;
  return contexts;
}

TEST(KnotContexts, LargeSurroundingsStartWithLargeKnots) {
  BitMixer mixer = started();
  for (std::uint32_t decision = is_not_zero; decision < sign_is_negative; ++decision) {
    EXPECT_LT(mixer.cost(extreme(decision, true), true), mixer.cost(extreme(decision, true), false))
        << decision;
    EXPECT_LT(mixer.cost(extreme(decision, false), false),
              mixer.cost(extreme(decision, false), true))
        << decision;
  }
}

TEST(KnotContexts, SignsStartEven) {
  BitMixer mixer = started();
  const auto contexts = extreme(sign_is_negative, false);
  // Costs are those of the middle of a sixteenth of 1/256.
  EXPECT_NEAR(mixer.cost(contexts, true), mixer.cost(contexts, false), 655);
}

}  // namespace
}  // namespace reprise
