#include "archive/take_layers.h"

#include <algorithm>
#include <functional>

#include "exact/text_codec.h"
#include "refine/coarse_channels.h"
#include "refine/refinement.h"

namespace reprise {
namespace {

/// Whether a fidelity has a refinement. A finer bound is coded on its own, since on top of
/// `standard` it takes a quarter more (docs/findings).
bool is_bounded(const Fidelity& fidelity) {
  return fidelity.tier != FidelityTier::preview && fidelity.tier != FidelityTier::exact;
}

class LayerMaker {
 public:
  LayerMaker(const CodedSpace& space, const CodingSource& source, bool contacts)
      : space_(space), source_(source), contacts_(contacts) {}

  /// On the axes of the space, or channel by channel where that is smaller.
  void add_coarsest(FittedTake fitted, double mean_mm) {
    const Take& take = source_.prepared.take;
    const TakeShape shape{take.frames(), take.frame_rate};
    const Bytes data = encode_motion(space_.model, space_.space, shape, fitted.motion);
    if (auto coarse = coarse_channels(source_.prepared, {mean_mm, contacts_, data.size()})) {
      add_channels({LayerKind::channels, mean_mm, 0}, "curves", std::move(*coarse));
      return;
    }
    CodedMotion without_contacts = fitted.motion;
    without_contacts.contacts = {};
    const std::size_t curves =
        encode_motion(space_.model, space_.space, shape, without_contacts).size();
    add_motion({LayerKind::coefficients, mean_mm, 0}, "curves", data,
               data.size() - std::min(data.size(), curves));
    decode_ = [this, shape, motion = std::move(fitted.motion)] {
      return motion_channels(space_.space, *source_.take.skeleton,
                             source_.prepared.header.constants, shape, motion);
    };
  }

  void add_refinement(const Fidelity& fidelity) {
    add_channels({LayerKind::refinement, fidelity.limit_mm, fidelity.limit_deg}, "refinement",
                 refine(source_.prepared, {fidelity.limit_mm, fidelity.limit_deg, contacts_}));
  }

  void add_text() {
    const Skeleton& skeleton = *source_.take.skeleton;
    const std::string known =
        skeleton.format == MotionFormat::bvh ? skeleton.source_text : std::string();
    Bytes data = encode_text(source_.text, known);
    count("text", data.size());
    made_.layers.push_back({LayerKind::text, 0, 0, std::move(data)});
  }

  /// Measures the finest layer.
  TakeLayers finish() {
    const Skeleton& skeleton = *source_.take.skeleton;
    const bool exact = made_.layers.back().kind == LayerKind::text;
    made_.distances = motion_distances(
        skeleton, source_.take.channels,
        exact ? source_.take.channels : restore_take(skeleton, source_.prepared.header, decode_()));
    made_.errors = summarise_motion(made_.distances, skeleton.joints.size());
    return std::move(made_);
  }

 private:
  struct Promise {
    LayerKind kind;
    double limit_mm, limit_deg;
  };

  void add_channels(const Promise& promise, const char* part, Refinement channels) {
    add_motion(promise, part, channels.bytes, channels.contact_bytes);
    decode_ = [decoded = std::move(channels.decoded)] { return decoded; };
  }

  /// Motion whose last `contacts` bytes, about, are contacts; the header counts as motion.
  void add_motion(const Promise& promise, const char* part, const Bytes& motion,
                  std::size_t contacts) {
    Bytes data = join_header(*source_.take.skeleton, space_.space.known, source_.take.frames(),
                             source_.prepared.header, motion);
    count(part, data.size() - contacts);
    count("contacts", contacts);
    made_.layers.push_back({promise.kind, promise.limit_mm, promise.limit_deg, std::move(data)});
  }

  void count(const std::string& part, std::size_t bytes) {
    if (bytes == 0) return;
    const auto known = std::ranges::find(made_.spent, part, &TakeLayers::Part::first);
    if (known != made_.spent.end()) {
      known->second += bytes;
    } else {
      made_.spent.emplace_back(part, bytes);
    }
  }

  const CodedSpace& space_;
  const CodingSource& source_;
  bool contacts_;
  TakeLayers made_;
  std::function<ChannelMatrix()> decode_;  ///< channels of the finest layer's prepared take
};

}  // namespace

TakeLayers make_layers(const IngestOptions& options, const CodedSpace& space,
                       const CodingSource& source, FittedTake fitted) {
  LayerMaker maker(space, source, options.contacts);
  if (fitted.kept) maker.add_coarsest(std::move(fitted), coarse_mean_mm(options.fidelity));
  if (is_bounded(options.fidelity)) maker.add_refinement(options.fidelity);
  if (options.fidelity.tier == FidelityTier::exact) maker.add_text();
  return maker.finish();
}

}  // namespace reprise
