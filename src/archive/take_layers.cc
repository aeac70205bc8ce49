#include "archive/take_layers.h"

#include "exact/text_codec.h"
#include "refine/refinement.h"

namespace reprise {
namespace {

/// The bounds that the refinements of a fidelity keep one after another; none for a preview. What
/// keeps a finer bound also holds `standard`, so that a reader who wants no more reads no more.
std::vector<double> bounds_of(const Fidelity& fidelity) {
  switch (fidelity.tier) {
    case FidelityTier::preview:
    case FidelityTier::exact:
      return {};
    default:
      if (fidelity.limit_mm >= FidelityLimits::standard_mm) return {fidelity.limit_mm};
      return {FidelityLimits::standard_mm, fidelity.limit_mm};
  }
}

class LayerMaker {
 public:
  LayerMaker(const CodedSpace& space, const Take& take) : space_(space), take_(take) {}

  void add_coefficients(FittedTake fitted, double mean_mm) {
    add(LayerKind::coefficients, mean_mm, 0, "curves",
        encode_motion(space_.model, fitted.shape, fitted.motion));
    made_.errors = fitted.errors;
    made_.distances = std::move(fitted.distances);
  }

  void add_refinements(const std::vector<double>& bounds) {
    const PositionMatrix positions = joint_positions(*take_.skeleton, take_.channels);
    ChannelMatrix lower;
    int base = 0;
    for (const double bound : bounds) {
      Refinement refined = refine(take_, base > 0 ? &lower : nullptr, bound, {});
      add(LayerKind::refinement, bound, base, "refinement", std::move(refined.bytes));
      base = static_cast<int>(made_.layers.size());
      lower = std::move(refined.decoded);
    }
    if (bounds.empty()) return;
    made_.distances = joint_distances(positions, joint_positions(*take_.skeleton, lower));
    made_.errors = summarise_distances(made_.distances);
  }

  void add_text(const std::string& text) {
    const std::string known =
        take_.skeleton->format == MotionFormat::bvh ? take_.skeleton->source_text : std::string();
    add(LayerKind::text, 0, 0, "text", encode_text(text, known));
    std::ranges::fill(made_.distances, 0.0F);
    made_.errors = {};
  }

  TakeLayers finish() { return std::move(made_); }

 private:
  void add(LayerKind kind, double limit_mm, int base, const char* part, Bytes data) {
    made_.spent.emplace_back(part, data.size());
    made_.layers.push_back({kind, limit_mm, base, std::move(data)});
  }

  const CodedSpace& space_;
  const Take& take_;
  TakeLayers made_;
};

}  // namespace

TakeLayers make_layers(const Fidelity& fidelity, const CodedSpace& space, const Take& take,
                       const std::string& text, FittedTake fitted) {
  LayerMaker maker(space, take);
  maker.add_coefficients(std::move(fitted), coarse_mean_mm(fidelity));
  maker.add_refinements(bounds_of(fidelity));
  if (fidelity.tier == FidelityTier::exact) maker.add_text(text);
  return maker.finish();
}

}  // namespace reprise
