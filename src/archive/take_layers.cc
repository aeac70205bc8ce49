#include "archive/take_layers.h"

#include "exact/text_codec.h"
#include "refine/coarse_channels.h"
#include "refine/refinement.h"

namespace reprise {
namespace {

/// The bound that the refinement of a fidelity keeps; nothing where it has none. A finer bound is
/// coded on its own, since on top of `standard` it takes a quarter more (docs/findings).
std::optional<double> bound_of(const Fidelity& fidelity) {
  const bool bounded =
      fidelity.tier != FidelityTier::preview && fidelity.tier != FidelityTier::exact;
  return bounded ? std::optional(fidelity.limit_mm) : std::nullopt;
}

class LayerMaker {
 public:
  LayerMaker(const CodedSpace& space, const Take& take, bool contacts)
      : space_(space), take_(take), contacts_(contacts) {}

  /// On the axes of the space, or channel by channel where that is smaller.
  void add_coarsest(FittedTake fitted, double mean_mm) {
    const TakeShape shape{take_.frames(), take_.frame_rate};
    Bytes data = encode_motion(space_.model, space_.space, shape, fitted.motion);
    if (auto coarse = coarse_channels(take_, {mean_mm, contacts_, data.size()})) {
      add_channels(LayerKind::channels, mean_mm, "curves", std::move(*coarse));
      return;
    }
    const std::size_t all = data.size();
    fitted.motion.contacts = {};
    const std::size_t curves =
        std::min(all, encode_motion(space_.model, space_.space, shape, fitted.motion).size());
    add(LayerKind::coefficients, mean_mm, {{"curves", curves}, {"contacts", all - curves}},
        std::move(data));
    made_.errors = fitted.errors;
    made_.distances = std::move(fitted.distances);
  }

  void add_refinement(double bound_mm) {
    add_channels(LayerKind::refinement, bound_mm, "refinement",
                 refine(take_, {bound_mm, contacts_}));
  }

  void add_text(const std::string& text) {
    const std::string known =
        take_.skeleton->format == MotionFormat::bvh ? take_.skeleton->source_text : std::string();
    add(LayerKind::text, 0, "text", encode_text(text, known));
    made_.distances.assign(static_cast<std::size_t>(take_.frames()) * take_.skeleton->joints.size(),
                           0.0F);
    made_.errors = {};
  }

  TakeLayers finish() { return std::move(made_); }

 private:
  void add_channels(LayerKind kind, double limit_mm, const char* part, Refinement channels) {
    const std::size_t contacts = channels.contact_bytes, rest = channels.bytes.size() - contacts;
    add(kind, limit_mm, {{part, rest}, {"contacts", contacts}}, std::move(channels.bytes));
    made_.distances = joint_distances(joint_positions(*take_.skeleton, take_.channels),
                                      joint_positions(*take_.skeleton, channels.decoded));
    made_.errors = summarise_distances(made_.distances);
  }
  void add(LayerKind kind, double limit_mm, const char* part, Bytes data) {
    const std::size_t size = data.size();
    add(kind, limit_mm, {{part, size}}, std::move(data));
  }
  void add(LayerKind kind, double limit_mm,
           const std::vector<std::pair<std::string, std::uint64_t>>& parts, Bytes data) {
    for (const auto& [name, bytes] : parts) {
      if (bytes == 0) continue;
      const auto known = std::ranges::find(made_.spent, name, &TakeLayers::Part::first);
      if (known != made_.spent.end()) {
        known->second += bytes;
      } else {
        made_.spent.emplace_back(name, bytes);
      }
    }
    made_.layers.push_back({kind, limit_mm, std::move(data)});
  }

  const CodedSpace& space_;
  const Take& take_;
  bool contacts_;
  TakeLayers made_;
};

}  // namespace

TakeLayers make_layers(const IngestOptions& options, const CodedSpace& space, const Take& take,
                       const std::string& text, FittedTake fitted) {
  LayerMaker maker(space, take, options.contacts);
  if (fitted.kept) maker.add_coarsest(std::move(fitted), coarse_mean_mm(options.fidelity));
  if (const auto bound = bound_of(options.fidelity)) maker.add_refinement(*bound);
  if (options.fidelity.tier == FidelityTier::exact) maker.add_text(text);
  return maker.finish();
}

}  // namespace reprise
